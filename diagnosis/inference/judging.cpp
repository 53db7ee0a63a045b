#include "diagnosis/inference/judging.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/problem.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::array<JudgingRow, 15> kTable{{
    {"decisive_nat", &Judging::decisive_nat, "nat",
     "evidence that a cause must gain to be named, and within which alternatives are ties",
     "odds of 148 : 1: `decisive` for Jeffreys (beyond 100 : 1), the border of `strong` and `very "
     "strong` in Kass and Raftery 1995. Of 180 healthy drawn rigs (seeds 150000, 150100) one has a "
     "candidate of 5.1 nat, the others 3.3 at most; 2 would accuse five; 10 would lose 7 of the 82 "
     "effects named in seeds 152000, 160000, 156000 and 156100 (2026-12-01)",
     "--clean 20 --seeds 22 --size 0.4 --sweep decisive_nat=2,5,10"},
    {"form_share", &Judging::form_share, "of the evidence explained",
     "further evidence that a second cause must gain beside a strong first one, a hum excepted",
     "force laws of magnets and contacts differ from the file by a tenth in amplitude, a hundredth "
     "in squared error; twice that. Of the 82 effects named in seeds 152000, 160000, 156000 and "
     "156100 five have a companion that is not there; of 16 pairs (154000) it hides an asymmetry "
     "of 115 nat beside a hysteresis of 10 000 (2026-12-01)",
     "--seeds 22 --size 2 --sweep form_share=0,0.02,0.1"},
    {"near_nat", &Judging::near_nat, "nat",
     "distance to the leader within which a hypothesis is fitted on the nonlinear model",
     "set by hand: a larger value costs time only", "--seeds 22 --size 1 --sweep near_nat=5,15,45"},
    {"exchange_share", &Judging::exchange_share, "of a cause's gain",
     "error of the linear screen that is allowed for when one of several causes is exchanged",
     "set by hand, for causes so strong that the screen errs by more than near_nat",
     "--pairs 16 --sweep exchange_share=0.1,0.4,0.8"},
    {"far_beyond", &Judging::far_beyond, "times what is enough",
     "screened evidence that is believed although the refit stopped before it gained enough",
     "set by hand", "--seeds 22 --size 2 --sweep far_beyond=1,3,1e9"},
    {"unexplained_sigma", &Judging::unexplained_sigma, "deviations of chance",
     "power of the residual, in its worst band, from which the answer may be `unknown`",
     "120 healthy drawn rigs (150100) leave 6.5 at most, 79 of the 82 effects named in seeds "
     "152000, 160000, 156000 and 156100 7.2 at most, the other three (backlash, rub, mode of the "
     "support) 90 and more: anything from 8 to 90 answers alike (2026-12-01)",
     "--clean 20 --outside 20 --sweep unexplained_sigma=5,15,30"},
    {"explained_share", &Judging::explained_share, "of the excess power",
     "least share that causes must take away where the residual still stands out",
     "judgement: it decides between 15 and 30 deviations, where none of the 111 trials of seeds "
     "152000, 160000, 156000 and 156100 lies, so that 0.4 to 0.9 answer alike (2026-12-01)",
     "--outside 20 --seeds 22 --size 2 --sweep explained_share=0.4,0.7,0.9"},
    {"stands_out_sigma", &Judging::stands_out_sigma, "deviations of chance",
     "power of the residual from which nearly_all_share counts in place of explained_share",
     "twice unexplained_sigma: an inexact force law leaves no line that stands out so far; none of "
     "the same 111 trials lies between 16 and 90 (2026-12-01)",
     "--outside 20 --seeds 22 --size 2 --sweep stands_out_sigma=15,30,60"},
    {"nearly_all_share", &Judging::nearly_all_share, "of the excess power",
     "least share that causes must take away where a line of the residual stands out",
     "judgement: of the same 111 trials 0.8 answers as 0.95 does, 0.99 would lose a backlash that "
     "leaves 540 deviations and explains 0.952 (156002, 2026-12-01)",
     "--outside 20 --seeds 22 --size 2 --sweep nearly_all_share=0.8,0.95,0.99"},
    {"harm_nat", &Judging::harm_nat, "nat",
     "loss on the validation data from which causes are no causes",
     "twice decisive_nat: validation data are a sixth of the records, on which the gain of a cause "
     "of 26 nat scattered by 5 nat (trial 25005, 2026)",
     "--clean 20 --seeds 22 --size 0.4 --sweep harm_nat=0,10,1e9"},
    {"gain_deviations", &Judging::gain_deviations, "deviations of the gain",
     "least gain of all causes together over the calibrated model, in squared innovations and "
     "squared tolerances, by the scatter of its paired differences from block to block",
     "95 % of one side of a normal distribution; white innovations give a gain of 5 nat beyond its "
     "Occam factor two",
     "--clean 20 --seeds 22 --size 0.4 --sweep gain_deviations=0,1.645,3"},
    {"moved_tolerances", &Judging::moved_tolerances, "tolerances",
     "distance from the file, less 1.645 posterior deviations, from which a calibrated number is "
     "tried as a cause and named if evidence prefers it at all",
     "a healthy rig within the file's tolerances stays below in 997 of 1000 numbers; a current "
     "gain "
     "12 % low at a tolerance of 3 % is worth 4 nat by construction (2026)",
     "--clean 20 --seeds 22 --size 0.4 --sweep moved_tolerances=2.5,3,1e9"},
    {"model_error_share", &Judging::model_error_share, "of the motion's rms",
     "least noise that a channel is taken to have: what a model foretells of a motion at best",
     "healthy rigs with probes of 0.05 um and two modes that their files lack: with 0.003 two of "
     "three were accused (13 and 193 nat), with 0.01 none (2 nat at most; trials 2001 to 2003 of "
     "2026)",
     "--clean 20 --seeds 22 --size 0.4 --sweep model_error_share=0.003,0.01,0.03"},
    {"number_chance", &Judging::number_chance, "of healthy rigs",
     "chance that some determined number of a healthy rig lies as far from the file, below which "
     "its "
     "effect is suspected",
     "the share of healthy rigs that may be suspected; it takes the tolerances as normal "
     "deviations. Of 180 healthy drawn rigs one is suspected (2026-12-01)",
     "--clean 20 --seeds 22 --size 0.4 --sweep number_chance=0.01,0.05,0.2"},
    {"suspected_nat", &Judging::suspected_nat, "nat",
     "evidence, and lead over the next effect, from which a cause is suspected although a residual "
     "is left",
     "what counts as clear in the benchmark: a hidden effect of so much evidence is not unknown. "
     "Of 14 drawn rigs outside the vocabulary none is suspected; a rub and a mode of the support "
     "that leave a residual are (160033, 160032, 2026-12-01)",
     "--outside 20 --seeds 22 --size 2 --sweep suspected_nat=10,25,100"},
}};

}  // namespace

const std::array<JudgingRow, 15>& JudgingTable() { return kTable; }

const JudgingRow& FindJudging(std::string_view name) {
  const auto* found = std::find_if(kTable.begin(), kTable.end(),
                                   [name](const JudgingRow& row) { return row.name == name; });
  if (found != kTable.end()) return *found;
  std::string allowed;
  for (const JudgingRow& row : kTable) {
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", row.name);
  }
  throw BadInput(
      fmt::format("no number of that name decides: found {}, allowed {}", name, allowed));
}

std::string JudgingMarkdown() {
  std::string text =
      "# Numbers that decide which answer a diagnosis gives\n\nPrinted by `amb bench diagnosis "
      "--constants`, from `diagnosis/inference/judging.cpp`. The last column is what to give to\n"
      "`amb bench diagnosis` to find a value again: the same trials run with each value in "
      "turn.\n\n"
      "| name | value | unit | decides | source | sweep |\n|---|---|---|---|---|---|\n";
  for (const JudgingRow& row : kTable) {
    text += fmt::format("| `{}` | {:g} | {} | {} | {} | `{}` |\n", row.name, Judging{}.*row.value,
                        row.unit, row.meaning, row.source, row.again);
  }
  return text;
}

}  // namespace levitas::diagnosis
