#include "lcmtypes/torsion/torsion_codec.hpp"

#include <algorithm>
#include <array>

#include "common/crc32.hpp"
#include "lcmtypes/checked_decode.hpp"

namespace levitas {
namespace {

constexpr std::size_t kCrcBytes = 4;
constexpr std::size_t kMostValues = kMaxCouplings * kTorsionSamples;

std::uint32_t CrcOf(std::span<const std::uint8_t> bytes) noexcept {
  constexpr std::array<std::uint8_t, kCrcBytes> kZero{};
  return Crc32(kZero.data(), kCrcBytes, Crc32(bytes.data(), bytes.size() - kCrcBytes));
}

}  // namespace

TorsionCodec::TorsionCodec() {
  message_.torque_n_m.reserve(kMostValues);
  message_.twist_rad.reserve(kMostValues);
}

std::size_t TorsionCodec::LargestSize() {
  levitas_msg::torsion_batch_t largest{};
  largest.values = static_cast<std::int32_t>(kMostValues);
  largest.torque_n_m.resize(kMostValues);
  largest.twist_rad.resize(kMostValues);
  return static_cast<std::size_t>(largest.getEncodedSize());
}

std::size_t TorsionCodec::Encode(const TorsionBatch& batch, std::span<std::uint8_t> to) noexcept {
  const std::size_t values = std::size_t{batch.couplings} * std::size_t{batch.samples};
  if (values > kMostValues) return 0;
  message_.first_cycle = static_cast<std::int64_t>(batch.first_cycle);
  message_.rig_session = static_cast<std::int32_t>(batch.rig_session);
  message_.couplings = static_cast<std::int32_t>(batch.couplings);
  message_.samples = static_cast<std::int32_t>(batch.samples);
  message_.values = static_cast<std::int32_t>(values);
  message_.torque_n_m.assign(batch.torque_n_m.begin(),
                             batch.torque_n_m.begin() + static_cast<std::ptrdiff_t>(values));
  message_.twist_rad.assign(batch.twist_rad.begin(),
                            batch.twist_rad.begin() + static_cast<std::ptrdiff_t>(values));
  message_.crc = 0;
  const int size = message_.encode(to.data(), 0, static_cast<int>(to.size()));
  if (size < static_cast<int>(kCrcBytes)) return 0;
  const auto written = to.first(static_cast<std::size_t>(size));
  const std::uint32_t crc = CrcOf(written);
  for (std::size_t i = 0; i < kCrcBytes; ++i) {
    written[written.size() - 1 - i] = static_cast<std::uint8_t>(crc >> (8U * i));
  }
  return written.size();
}

bool TorsionCodec::Decode(std::span<const std::uint8_t> bytes, TorsionBatch& batch) noexcept {
  if (!message::DecodeChecked(bytes, message_)) return false;
  if (CrcOf(bytes) != static_cast<std::uint32_t>(message_.crc)) return false;
  // Each on its own: a product of two that lie can be right.
  const auto within = [](std::int32_t count, std::size_t most) {
    return count > 0 && static_cast<std::size_t>(count) <= most;
  };
  if (!within(message_.samples, kTorsionSamples) || !within(message_.couplings, kMaxCouplings)) {
    return false;
  }
  const auto samples = static_cast<std::size_t>(message_.samples);
  const auto couplings = static_cast<std::size_t>(message_.couplings);
  const auto values = static_cast<std::size_t>(message_.values);
  if (values != samples * couplings) return false;
  batch.first_cycle = static_cast<std::uint64_t>(message_.first_cycle);
  batch.rig_session = static_cast<std::uint32_t>(message_.rig_session);
  batch.couplings = static_cast<std::uint32_t>(couplings);
  batch.samples = static_cast<std::uint32_t>(samples);
  std::copy_n(message_.torque_n_m.begin(), values, batch.torque_n_m.begin());
  std::copy_n(message_.twist_rad.begin(), values, batch.twist_rad.begin());
  return true;
}

}  // namespace levitas
