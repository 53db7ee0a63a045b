#pragma once
// The live page beside `amb run`: whether it is served, and whether a browser is sent to it.
//
// Served    on a terminal when the run keeps the clock's pace, real time or paced (one in lockstep
//           is over before a browser has started); whenever it is asked for; never when it is
//           refused.
// Stays     after the run, whatever came of it, until Ctrl-C: whoever looks sees how it ended. Not
//           where Ctrl-C has ended the run: that was meant for both.
// Opened    only where somebody sits before a desktop, never under automation (variable CI set).
// Failure   the page is beside the point of a run: what goes wrong with it is said, not thrown.
// Thread    construct and destroy from the thread that runs; the page has threads of its own.

#include <functional>
#include <memory>
#include <string>

#include "common/problem.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::dashboard {
class Dashboard;
}

namespace levitas::cli {

enum class PageWish { kIfUseful, kAlways, kNever };

/// What decides, apart from the wish.
struct PageSurroundings {
  bool terminal{};    ///< somebody reads what is printed
  bool desktop{};     ///< a browser could be shown
  bool automation{};  ///< CI is set
  bool clocked{};     ///< the run keeps the clock's pace
};

struct PagePlan {
  bool serve{};
  bool open{};  ///< send the desktop's browser there
};

[[nodiscard]] PagePlan PlanPage(PageWish wish, const PageSurroundings& around) noexcept;

/// Of this process: terminal on stdout and stderr, DISPLAY or WAYLAND_DISPLAY, CI.
[[nodiscard]] PageSurroundings LookAround(bool clocked);

class LivePage {
 public:
  /// `say` takes a line for people; `plan.serve` false: nothing happens.
  LivePage(const PagePlan& plan, const transport::LcmNetwork& network,
           const std::function<void(const std::string&)>& say);
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  /// What a run leaves behind as soon as it is known.
  struct Ending {
    bool interrupted{};
    std::string verdict;  ///< its sentence; empty: none was reached
    /// To be called when the controller has ended in order: viewers are told so at once. Judging
    /// takes a second or more, in which the page would take its silence for a loss.
    std::function<void(ExitStatus)> over{[](ExitStatus) {}};
  };

  /// The exit status of `run`, at once without a page. With one: what `run` throws is said, and
  /// viewers are told that it is over, with its verdict. The page then stays until Ctrl-C, unless a
  /// Ctrl-C has ended the run itself.
  [[nodiscard]] ExitStatus Outlive(const std::function<ExitStatus(Ending&)>& run);

 private:
  std::unique_ptr<dashboard::Dashboard> page_;
  std::function<void(const std::string&)> say_;
};

}  // namespace levitas::cli
