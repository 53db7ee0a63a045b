#include "session/exchange/mcap_writer.hpp"

#include <algorithm>
#include <utility>

#include "common/crc32.hpp"

namespace levitas::session {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum Opcode : char {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kDataEnd = 0x0F,
};

std::string Record(Opcode opcode, const McapBytes& content) {
  McapBytes record;
  record.Raw({reinterpret_cast<const char*>(&opcode), 1});
  record.U64(content.bytes().size()).Raw(content.bytes());
  return record.bytes();
}

std::uint32_t Crc(std::string_view bytes, std::uint32_t before = 0) {
  return Crc32(bytes.data(), bytes.size(), before);
}

/// A map from channel to a number, with its length in bytes before it.
McapBytes& PutMap(McapBytes& into, const std::map<std::uint16_t, std::uint64_t>& map) {
  into.U32(static_cast<std::uint32_t>(map.size() * 10));
  for (const auto& [key, value] : map) into.U16(key).U64(value);
  return into;
}

}  // namespace

McapBytes& McapBytes::Number(std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xFFU);
  return *this;
}

McapBytes& McapBytes::Raw(std::string_view bytes) {
  bytes_ += bytes;
  return *this;
}

McapBytes& McapBytes::Text(std::string_view text) {
  return U32(static_cast<std::uint32_t>(text.size())).Raw(text);
}

McapWriter::McapWriter(Sink out, const std::string& library) : out_(std::move(out)) {
  Put(kMagic);
  Put(Record(kHeader, McapBytes().Text("").Text(library)));
}

void McapWriter::Put(std::string_view bytes) {
  out_(bytes);
  at_ += bytes.size();
  crc_ = Crc(bytes, crc_);
}

std::uint16_t McapWriter::AddSchema(const std::string& name, const std::string& encoding,
                                    const std::string& data) {
  const std::string record =
      Record(kSchema, McapBytes().U16(++schema_count_).Text(name).Text(encoding).Text(data));
  schemas_ += record;
  Put(record);
  return schema_count_;
}

std::uint16_t McapWriter::AddChannel(std::uint16_t schema, const std::string& topic,
                                     const std::string& encoding) {
  const std::string record = Record(
      kChannel, McapBytes().U16(++channel_count_).U16(schema).Text(topic).Text(encoding).U32(0));
  channels_ += record;
  Put(record);
  counts_[channel_count_] = 0;
  return channel_count_;
}

void McapWriter::AddMetadata(const std::string& name,
                             const std::map<std::string, std::string>& metadata) {
  McapBytes map;
  for (const auto& [key, value] : metadata) map.Text(key).Text(value);
  const std::uint64_t start = at_;
  Put(Record(kMetadata, McapBytes().Text(name).Text(map.bytes())));
  metadata_indexes_ += Record(kMetadataIndex, McapBytes().U64(start).U64(at_ - start).Text(name));
  ++metadata_count_;
}

void McapWriter::Write(std::uint16_t channel, std::int64_t time_ns, std::string_view data) {
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
  chunk_first_ns_ = chunk_.empty() ? time : std::min(chunk_first_ns_, time);
  chunk_last_ns_ = chunk_.empty() ? time : std::max(chunk_last_ns_, time);
  chunk_messages_[channel].emplace_back(time, chunk_.size());
  const auto sequence = static_cast<std::uint32_t>(counts_[channel]++);
  chunk_ += Record(kMessage, McapBytes().U16(channel).U32(sequence).U64(time).U64(time).Raw(data));
  if (chunk_.size() >= kChunkBytes) FlushChunk();
}

void McapWriter::FlushChunk() {
  if (chunk_.empty()) return;
  ChunkIndex index{};
  index.first_ns = chunk_first_ns_;
  index.last_ns = chunk_last_ns_;
  index.start = at_;
  index.size = chunk_.size();
  Put(Record(kChunk, McapBytes()
                         .U64(chunk_first_ns_)
                         .U64(chunk_last_ns_)
                         .U64(chunk_.size())
                         .U32(Crc(chunk_))
                         .Text("")  // no compression
                         .U64(chunk_.size())
                         .Raw(chunk_)));
  index.length = at_ - index.start;
  PutMessageIndexes(index);
  indexes_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_.clear();
}

void McapWriter::PutMessageIndexes(ChunkIndex& index) {
  const std::uint64_t begin = at_;
  for (const auto& [channel, messages] : chunk_messages_) {
    index.index_at[channel] = at_;
    McapBytes content;
    content.U16(channel).U32(static_cast<std::uint32_t>(messages.size() * 16));
    for (const auto& [time, offset] : messages) content.U64(time).U64(offset);
    Put(Record(kMessageIndex, content));
  }
  index.index_length = at_ - begin;
}

std::string McapWriter::Statistics() const {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_) messages += count;
  std::uint64_t first_ns = indexes_.empty() ? 0 : indexes_.front().first_ns;
  std::uint64_t last_ns = 0;
  for (const ChunkIndex& index : indexes_) {
    first_ns = std::min(first_ns, index.first_ns);
    last_ns = std::max(last_ns, index.last_ns);
  }
  McapBytes content;
  content.U64(messages).U16(schema_count_).U32(channel_count_).U32(0).U32(metadata_count_);
  content.U32(static_cast<std::uint32_t>(indexes_.size())).U64(first_ns).U64(last_ns);
  return Record(kStatistics, PutMap(content, counts_));
}

std::string McapWriter::Summary() const {
  std::string summary = schemas_ + channels_ + Statistics();
  for (const ChunkIndex& index : indexes_) {
    McapBytes content;
    content.U64(index.first_ns).U64(index.last_ns).U64(index.start).U64(index.length);
    PutMap(content, index.index_at);
    content.U64(index.index_length).Text("").U64(index.size).U64(index.size);
    summary += Record(kChunkIndex, content);
  }
  return summary + metadata_indexes_;
}

void McapWriter::Finish() {
  FlushChunk();
  Put(Record(kDataEnd, McapBytes().U32(crc_)));
  const std::uint64_t summary_at = at_;
  const std::string summary = Summary();
  Put(summary);
  // The summary's CRC covers the footer as well, up to the CRC itself.
  McapBytes footer;
  footer.U64(summary_at).U64(0);
  McapBytes covered;
  covered.Raw("\x02").U64(footer.bytes().size() + 4).Raw(footer.bytes());
  footer.U32(Crc(covered.bytes(), Crc(summary)));
  Put(Record(kFooter, footer));
  Put(kMagic);
}

}  // namespace levitas::session
