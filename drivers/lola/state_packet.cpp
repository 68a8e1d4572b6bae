#include "drivers/lola/state_packet.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <msgpack.hpp>

namespace gazed::lola {

/// Called for what comes, in the packet's order; false ends the parsing.
class StatePacketParser::Visitor : public msgpack::null_visitor {
 public:
  void init() {
    field_ = nullptr;
    seen_ = 0;
    in_map_ = in_key_ = in_array_ = false;
  }
  [[nodiscard]] bool complete() const { return seen_ == (1U << fields_.size()) - 1; }
  [[nodiscard]] const LolaState& state() const { return state_; }

  bool start_map(std::uint32_t) {
    const bool is_first = !in_map_;
    in_map_ = true;
    return is_first;
  }
  bool start_map_key() {
    in_key_ = true;
    return true;
  }
  bool end_map_key() {
    in_key_ = false;
    return true;
  }
  bool visit_str(const char* text, std::uint32_t bytes) {
    return in_key_ ? begin_field({text, bytes}) : passed_over();
  }
  bool start_array(std::uint32_t count) {
    if (!in_map_ || in_key_ || in_array_) return false;
    in_array_ = true;
    at_ = 0;
    return field_ == nullptr || count == field_->size();
  }
  bool end_array() {
    in_array_ = false;
    if (field_ != nullptr) seen_ |= bit(*field_);
    return true;
  }
  bool visit_float32(float value) {
    return store(value, field_ != nullptr ? field_->floats : std::span<float>());
  }
  bool visit_positive_integer(std::uint64_t value) {
    return store(static_cast<std::uint8_t>(std::min<std::uint64_t>(value, UINT8_MAX)),
                 field_ != nullptr ? field_->integers : std::span<std::uint8_t>());
  }
  bool visit_negative_integer(std::int64_t) { return passed_over(); }
  bool visit_float64(double) { return passed_over(); }
  bool visit_boolean(bool) { return passed_over(); }
  bool visit_nil() { return passed_over(); }
  bool visit_bin(const char*, std::uint32_t) { return passed_over(); }
  bool visit_ext(const char*, std::uint32_t) { return passed_over(); }

 private:
  /// An array of the packet that is needed, and where its numbers go: floats or small integers.
  struct Field {
    std::string_view key;
    std::span<float> floats;
    std::span<std::uint8_t> integers;

    [[nodiscard]] std::size_t size() const { return floats.size() + integers.size(); }
  };

  [[nodiscard]] std::uint32_t bit(const Field& field) const {
    return 1U << static_cast<unsigned>(&field - fields_.data());
  }
  bool begin_field(std::string_view key) {
    const auto found = std::ranges::find(fields_, key, &Field::key);
    field_ = found == fields_.end() ? nullptr : &*found;
    return field_ == nullptr || (seen_ & bit(*field_)) == 0;
  }
  /// Whether this may stand here unread: as the value of a key that is not needed.
  [[nodiscard]] bool passed_over() const { return !in_key_ && field_ == nullptr; }
  template <class Number>
  bool store(Number value, std::span<Number> numbers) {
    if (!in_array_ || field_ == nullptr) return passed_over();
    if (at_ >= numbers.size()) return false;  // the other type, or more than were announced
    numbers[at_++] = value;
    return true;
  }

  LolaState state_;
  std::array<Field, 6> fields_{{{"Position", state_.position_rad, {}},
                                {"Stiffness", state_.stiffness, {}},
                                {"Temperature", state_.temperature_c, {}},
                                {"Current", state_.current_a, {}},
                                {"Angles", state_.torso_rad, {}},
                                {"Status", {}, state_.temperature_status}}};
  const Field* field_ = nullptr;  // whose value is being read
  std::size_t at_ = 0;            // in its array
  std::uint32_t seen_ = 0;        // a bit for each field
  bool in_map_ = false, in_key_ = false, in_array_ = false;
};

/// msgpack's streaming parser, because it keeps its stack; the one-shot function allocates one.
class StatePacketParser::Parser : public msgpack::parser<Parser, void(char*)> {
 public:
  Parser() : msgpack::parser<Parser, void(char*)>(refer, buffer_bytes) {}

  // What msgpack::parser asks of it.
  [[nodiscard]] Visitor& visitor() { return visitor_; }
  [[nodiscard]] static bool referenced() { return false; }
  static void set_referenced(bool) {}

 private:
  static constexpr std::size_t buffer_bytes = 4 * state_packet_bytes;

  /// Told of a buffer that somebody refers to; nobody does.
  static void refer(char*) {}

  Visitor visitor_;
};

StatePacketParser::StatePacketParser() : parser_(std::make_unique<Parser>()) {}
StatePacketParser::~StatePacketParser() = default;

std::optional<LolaState> StatePacketParser::parse(StatePacket packet) {
  parser_->reset();  // calls init()
  parser_->reserve_buffer(packet.size());
  std::memcpy(parser_->buffer(), packet.data(), packet.size());
  parser_->buffer_consumed(packet.size());
  bool whole = false;
  try {
    whole = parser_->next() && parser_->nonparsed_size() == 0;
  } catch (const msgpack::unpack_error&) {  // an extension longer than memory, where that is 32 bit
  }
  parser_->skip_nonparsed_buffer(parser_->nonparsed_size());
  if (!whole || !parser_->visitor().complete()) return std::nullopt;
  return parser_->visitor().state();
}

}  // namespace gazed::lola
