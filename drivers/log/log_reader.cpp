#include "drivers/log/log_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <unistd.h>
#include <utility>

#include "agent/base/counted.hpp"
#include "drivers/lcm/big_endian.hpp"

namespace gazed::log {

namespace {

// Ten times the largest frame of a NAO's camera, 2560x1920 YUYV; what claims more is damaged.
constexpr std::int32_t largest_message_bytes = 100'000'000;
constexpr std::size_t search_piece_bytes = 65'536;
constexpr std::size_t most_channels_listed = 20;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw std::invalid_argument("cannot read the log " + path + ": " + reason);
}

base::RegularFile open_log(const std::string& path) {
  base::RegularFile file = base::open_regular_file(path);
  if (!file.problem.empty()) refuse(path, file.problem);
  return file;
}

std::int64_t event_bytes(const LogEventHeader& header) {
  return static_cast<std::int64_t>(log_header_bytes) + header.channel_bytes + header.message_bytes;
}

// As LCM's programs name channels: nothing that a terminal would not show.
bool is_channel_name(const std::string& name) {
  return std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

LogReader::LogReader(std::string path, std::string channel)
    : path_(std::move(path)), channel_(std::move(channel)), file_(open_log(path_)) {}

bool LogReader::read_at(std::int64_t offset, std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = pread(file_.descriptor.get(), bytes.data(), bytes.size(), offset);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      error_ = count < 0 ? errno : EIO;  // 0: the file has become shorter since it was opened
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += count;
  }
  return true;
}

bool LogReader::is_event_boundary(std::int64_t offset) {
  std::array<std::uint8_t, sizeof(log_sync_word)> word{};
  const auto word_bytes = static_cast<std::int64_t>(word.size());
  if (offset == file_.bytes) return true;
  return offset + word_bytes <= file_.bytes && read_at(offset, word) &&
         lcm::read_big_endian<std::uint32_t>(word) == log_sync_word;
}

// The header of the event that begins there, if one can; its channel is left in event_channel_.
std::optional<LogEventHeader> LogReader::event_at(std::int64_t offset) {
  std::array<std::uint8_t, log_header_bytes + longest_channel_name> bytes{};
  const std::int64_t available = file_.bytes - offset;
  const auto beginning = std::span(bytes).first(static_cast<std::size_t>(
      std::min<std::int64_t>(available, static_cast<std::int64_t>(bytes.size()))));
  if (!read_at(offset, beginning)) return std::nullopt;
  // What lies beyond the end of the file is zero here: no channel has a name of no bytes.
  const LogEventHeader header = decode(std::span(bytes).first<log_header_bytes>());
  if (header.sync_word != log_sync_word) return std::nullopt;
  if (header.channel_bytes < 1 ||
      header.channel_bytes > static_cast<std::int32_t>(longest_channel_name) ||
      header.message_bytes < 0 || header.message_bytes > largest_message_bytes ||
      event_bytes(header) > available) {
    ++impossible_sizes_;
    return std::nullopt;
  }
  const auto name =
      std::span(bytes).subspan(log_header_bytes, static_cast<std::size_t>(header.channel_bytes));
  event_channel_.assign(name.begin(), name.end());
  if (!is_channel_name(event_channel_)) return std::nullopt;
  return header;
}

void LogReader::note_channel() {
  if (channels_.size() < most_channels_listed &&
      std::ranges::find(channels_, event_channel_) == channels_.end()) {
    channels_.push_back(event_channel_);
  }
}

// From the byte after position_, to the next sync word or the end.
void LogReader::skip_to_sync_word() {
  constexpr std::int64_t overlap = sizeof(log_sync_word) - 1;  // a word can lie across two pieces
  std::array<std::uint8_t, sizeof(log_sync_word)> word{};
  lcm::write_big_endian(log_sync_word, word);
  const std::int64_t from = position_;
  std::int64_t piece_at = from + 1;
  position_ = file_.bytes;
  while (piece_at + overlap < file_.bytes) {
    search_.resize(static_cast<std::size_t>(
        std::min<std::int64_t>(search_piece_bytes, file_.bytes - piece_at)));
    if (!read_at(piece_at, search_)) break;
    const auto found = std::search(search_.begin(), search_.end(), word.begin(), word.end());
    if (found != search_.end()) {
      position_ = piece_at + (found - search_.begin());
      break;
    }
    piece_at += static_cast<std::int64_t>(search_.size()) - overlap;
  }
  // The message before was used; that its size was right shows when nothing begins inside it.
  const std::int64_t skipped_from = position_ >= used_until_ ? std::max(from, used_until_) : from;
  if (skipped_places_++ == 0) first_skipped_at_ = skipped_from;
  skipped_bytes_ += position_ - skipped_from;
}

// Goes on behind the next event, whose channel is then event_channel_.
std::optional<LogReader::MessagePlace> LogReader::pass_event() {
  while (error_ == 0 && position_ < file_.bytes) {
    const std::int64_t event_begin = position_;
    const std::optional<LogEventHeader> header = event_at(event_begin);
    if (!header) {
      skip_to_sync_word();
      continue;
    }
    note_channel();
    const std::int64_t event_end = event_begin + event_bytes(*header);
    const std::int64_t message_begin = event_end - header->message_bytes;
    // Where none ends, its size may be a lie: an event may begin inside of it.
    position_ = is_event_boundary(event_end) ? event_end : message_begin;
    used_until_ = event_end;
    return MessagePlace{message_begin, static_cast<std::size_t>(header->message_bytes)};
  }
  return std::nullopt;
}

std::optional<std::span<const std::uint8_t>> LogReader::next_message() {
  while (const auto place = pass_event()) {
    if (event_channel_ != channel_) continue;
    message_.resize(place->bytes);
    if (read_at(place->begin, message_)) return message_;
  }
  return std::nullopt;
}

std::string LogReader::next_channel() {
  return pass_event() ? event_channel_ : std::string();
}

std::string LogReader::why_no_log() {
  struct Format {
    std::string_view beginning, name, remedy;
  };
  constexpr auto known = std::to_array<Format>({
      {"\x1F\x8B", "gzip data", "; unpack it first: gunzip"},
      {"\xFD\x37zXZ", "xz data", "; unpack it first: unxz"},
      {"\x28\xB5\x2F\xFD", "zstd data", "; unpack it first: unzstd"},
      {"BZh", "bzip2 data", "; unpack it first: bunzip2"},
      {"PK\x03\x04", "a ZIP archive", "; unpack it first: unzip"},
      {"#ROSBAG", "a ROS bag", ""},
  });
  if (file_.bytes == 0) return path_ + " is empty";
  std::array<char, 8> beginning{};
  const auto readable = std::min<std::int64_t>(file_.bytes, std::ssize(beginning));
  const auto bytes = std::span(beginning).first(static_cast<std::size_t>(readable));
  static_cast<void>(read_at(0, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}));
  const std::string_view text(bytes.data(), bytes.size());
  for (const auto& [start, name, remedy] : known) {
    if (!text.starts_with(start)) continue;
    return path_ + " is no LCM log but " + std::string(name) + std::string(remedy);
  }
  return path_ + " is no LCM log: no event begins in it";
}

std::string LogReader::notes() const {
  std::string text;
  if (impossible_sizes_ > 0) {
    text = path_ + ": " + base::counted(impossible_sizes_, "event") +
           " cut short or of impossible size";
  }
  if (skipped_places_ > 0) {
    text += text.empty() ? path_ + ": " : "; ";
    text += base::counted(skipped_bytes_, "byte") + " passed over in " +
            base::counted(skipped_places_, "place") + " to find the next event, first at byte " +
            std::to_string(first_skipped_at_);
  }
  return text;
}

std::string LogReader::fault() const {
  if (error_ == 0) return {};
  return "cannot read the log " + path_ + " to its end: " + std::strerror(error_);
}

std::string recorded_configuration(const std::string& path, const lcm::Channels& channels) {
  LogReader reader(path, channels.configuration);
  const auto text = reader.next_message();
  return text ? std::string(text->begin(), text->end()) : std::string();
}

std::string recorded_configuration(const std::string& path, const std::string& otherwise) {
  return recorded_configuration(path, lcm::Channels(recorded_prefix(path, otherwise)));
}

std::string recorded_prefix(const std::string& path, const std::string& otherwise) {
  constexpr std::string_view ending = "_CONFIGURATION";
  const std::string first = LogReader(path, {}).next_channel();
  if (!first.ends_with(ending)) return otherwise;
  const std::string prefix = first.substr(0, first.size() - ending.size());
  try {
    (void)lcm::Channels(prefix);
  } catch (const std::invalid_argument&) {
    return otherwise;  // of somebody else's
  }
  return prefix;
}

}  // namespace gazed::log
