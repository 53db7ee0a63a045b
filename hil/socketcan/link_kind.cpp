#include "hil/socketcan/link_kind.hpp"

#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace levitas::socketcan {
namespace {

constexpr std::size_t kMostBytes = 32'768;  // of an answer; the kernel sends about 1500

/// What lies in an attribute of the kernel's answer.
using Piece = std::string_view;

/// The content of the first attribute `type` in `list`; empty when there is none.
Piece Find(Piece list, std::uint16_t type) {
  rtattr head{};
  while (list.size() >= sizeof(head)) {
    std::memcpy(&head, list.data(), sizeof(head));
    if (head.rta_len < sizeof(head) || head.rta_len > list.size()) break;
    if ((head.rta_type & NLA_TYPE_MASK) == type) {
      return list.substr(RTA_LENGTH(0), head.rta_len - RTA_LENGTH(0));
    }
    list.remove_prefix(std::min<std::size_t>(RTA_ALIGN(head.rta_len), list.size()));
  }
  return {};
}

/// Everything the kernel tells about an interface, as one message; empty when it does not.
std::string Ask(int netlink, unsigned index) {
  struct {
    nlmsghdr head;
    ifinfomsg body;
  } request{};
  request.head.nlmsg_len = NLMSG_LENGTH(sizeof(request.body));
  request.head.nlmsg_type = RTM_GETLINK;
  request.head.nlmsg_flags = NLM_F_REQUEST;
  request.body.ifi_family = AF_UNSPEC;
  request.body.ifi_index = static_cast<int>(index);
  if (send(netlink, &request, request.head.nlmsg_len, 0) < 0) return {};
  std::string answer(kMostBytes, '\0');
  const ssize_t bytes = recv(netlink, answer.data(), answer.size(), 0);
  answer.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
  return answer;
}

/// IFLA_INFO_KIND of an answer; empty when the driver has none.
std::string Driver(const std::string& answer) {
  constexpr std::size_t kHeads = NLMSG_LENGTH(NLMSG_ALIGN(sizeof(ifinfomsg)));
  nlmsghdr head{};
  if (answer.size() < kHeads) return {};
  std::memcpy(&head, answer.data(), sizeof(head));
  if (head.nlmsg_type != RTM_NEWLINK) return {};
  const Piece kind = Find(Find(Piece(answer).substr(kHeads), IFLA_LINKINFO), IFLA_INFO_KIND);
  return std::string(kind.substr(0, kind.find('\0')));
}

}  // namespace

LinkKind FindLink(const std::string& interface) {
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) return LinkKind::kAbsent;
  const int netlink = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (netlink < 0) return LinkKind::kReal;
  const LinkKind kind = KindOf(Driver(Ask(netlink, index)));
  close(netlink);
  return kind;
}

}  // namespace levitas::socketcan
