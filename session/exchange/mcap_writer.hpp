#pragma once
// Writes an MCAP file (mcap.dev, specification of format 0): time series for Foxglove, PlotJuggler
// and the mcap libraries. Debian 12 has no package of one for C++; the part needed here is small.
//
// Layout    header, chunks without compression with an index behind each, the summary (schemas,
//           channels, statistics, chunk indexes), footer. Every CRC that the format knows is set.
// Memory    one chunk of about kChunkBytes, and 40 bytes a chunk for the index.
// Units     times in nanoseconds since 1970 UTC, messages in any order; numbers little-endian.
// Thread    one. Failure: what the sink throws.
// Not done  no compression, attachments or summary offsets: a reader that wants them rewrites.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::session {

/// Bytes of a record, number by number.
class McapBytes {
 public:
  McapBytes& U16(std::uint16_t value) { return Number(value, 2); }
  McapBytes& U32(std::uint32_t value) { return Number(value, 4); }
  McapBytes& U64(std::uint64_t value) { return Number(value, 8); }
  McapBytes& Raw(std::string_view bytes);
  /// With its length before it.
  McapBytes& Text(std::string_view text);
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  McapBytes& Number(std::uint64_t value, int size);
  std::string bytes_;
};

class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1U << 20U;

  using Sink = std::function<void(std::string_view)>;
  McapWriter(Sink out, const std::string& library);

  /// `encoding` "protobuf": `data` is a FileDescriptorSet. Before the first message.
  [[nodiscard]] std::uint16_t AddSchema(const std::string& name, const std::string& encoding,
                                        const std::string& data);
  [[nodiscard]] std::uint16_t AddChannel(std::uint16_t schema, const std::string& topic,
                                         const std::string& encoding);
  void AddMetadata(const std::string& name, const std::map<std::string, std::string>& metadata);
  void Write(std::uint16_t channel, std::int64_t time_ns, std::string_view data);
  /// The last chunk, the summary and the footer; nothing may follow.
  void Finish();

 private:
  struct ChunkIndex {
    std::uint64_t first_ns, last_ns, start, length, index_length, size;
    std::map<std::uint16_t, std::uint64_t> index_at;
  };

  void Put(std::string_view bytes);
  void FlushChunk();
  void PutMessageIndexes(ChunkIndex& index);
  [[nodiscard]] std::string Summary() const;
  [[nodiscard]] std::string Statistics() const;

  Sink out_;
  std::uint64_t at_{0};
  std::uint32_t crc_{0};            ///< of the data section so far
  std::string schemas_, channels_;  ///< records, for the summary
  std::uint16_t schema_count_{0}, channel_count_{0};
  std::uint32_t metadata_count_{0};
  std::string metadata_indexes_;  ///< records, for the summary
  std::string chunk_;
  std::uint64_t chunk_first_ns_{0}, chunk_last_ns_{0};
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;
  std::vector<ChunkIndex> indexes_;
  std::map<std::uint16_t, std::uint64_t> counts_;
};

}  // namespace levitas::session
