#include "drivers/lola/state_packet.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <msgpack.hpp>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::lola {

/// Callbacks for the values, in the packet's order; returning false ends the parsing.
class StatePacketParser::Visitor : public msgpack::null_visitor {
 public:
  void init() {
    field_ = nullptr;
    seen_ = 0;
    in_map_ = in_key_ = in_array_ = false;
    problem_ = {};
  }
  [[nodiscard]] bool complete() const { return seen_ == (1U << fields_.size()) - 1; }
  [[nodiscard]] const LolaState& state() const { return state_; }
  [[nodiscard]] bool is_map() const { return in_map_; }
  /// What ended the parsing; empty if nothing did.
  [[nodiscard]] std::string problem() const {
    if (problem_.what == nullptr) return {};
    if (problem_.wanted > 0)
      return base::text("%s has %zu values, LoLA's %zu", std::string(problem_.key).c_str(),
                        problem_.found, problem_.wanted);
    return std::string(problem_.key) + problem_.what;
  }
  [[nodiscard]] std::string missing() const {
    std::string keys;
    for (const Field& field : fields_) {
      if ((seen_ & bit(field)) == 0) keys.append(keys.empty() ? "" : ", ").append(field.key);
    }
    return keys;
  }

  bool start_map(std::uint32_t) {
    if (std::exchange(in_map_, true)) return refuse({.what = "a map inside the map"});
    return true;
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
    return in_key_ ? begin_field({text, bytes}) : passed_over(" is, or holds, text");
  }
  bool start_array(std::uint32_t count) {
    if (!in_map_ || in_key_ || in_array_) return refuse({.what = "an array where none belongs"});
    in_array_ = true;
    at_ = 0;
    if (field_ == nullptr || count == field_->size()) return true;
    return refuse({field_->key, "", count, field_->size()});
  }
  bool end_array() {
    in_array_ = false;
    if (field_ != nullptr) seen_ |= bit(*field_);
    return true;
  }
  bool visit_float32(float value) {
    return store(value, field_ != nullptr ? field_->floats : std::span<float>(),
                 " is, or holds, float32");
  }
  bool visit_positive_integer(std::uint64_t value) {
    return store(static_cast<std::uint8_t>(std::min<std::uint64_t>(value, UINT8_MAX)),
                 field_ != nullptr ? field_->integers : std::span<std::uint8_t>(),
                 " is, or holds, an integer");
  }
  bool visit_negative_integer(std::int64_t) {
    return passed_over(" is, or holds, a negative integer");
  }
  bool visit_float64(double) { return passed_over(" is, or holds, float64"); }
  bool visit_boolean(bool) { return passed_over(" is, or holds, true or false"); }
  bool visit_nil() { return passed_over(" is, or holds, nil"); }
  bool visit_bin(const char*, std::uint32_t) { return passed_over(" is, or holds, bytes"); }
  bool visit_ext(const char*, std::uint32_t) { return passed_over(" is, or holds, an extension"); }

 private:
  /// A required array, and where its numbers go: floats or small integers.
  struct Field {
    std::string_view key;
    std::span<float> floats;
    std::span<std::uint8_t> integers;

    [[nodiscard]] std::size_t size() const { return floats.size() + integers.size(); }
  };

  /// Why parsing ended, as string literals: nothing is allocated until somebody asks.
  struct Problem {
    std::string_view key{};
    const char* what = nullptr;
    std::size_t found = 0, wanted = 0;  // number of values in an array
  };

  [[nodiscard]] std::uint32_t bit(const Field& field) const {
    return 1U << static_cast<unsigned>(&field - fields_.data());
  }
  bool begin_field(std::string_view key) {
    const auto found = std::ranges::find(fields_, key, &Field::key);
    field_ = found == fields_.end() ? nullptr : &*found;
    if (field_ == nullptr || (seen_ & bit(*field_)) == 0) return true;
    return refuse({field_->key, " is there twice"});
  }
  /// True if this may be skipped here, as the value of a key that is not needed.
  bool passed_over(const char* is_type) {
    if (!in_key_ && field_ == nullptr) return true;
    return refuse({in_key_ ? "a key" : field_->key, is_type});
  }
  bool refuse(const Problem& problem) {
    problem_ = problem;
    return false;
  }
  template <class Number>
  bool store(Number value, std::span<Number> numbers, const char* type) {
    // Wrong type, or more values than announced.
    if (!in_array_ || field_ == nullptr || at_ >= numbers.size()) return passed_over(type);
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
  std::size_t at_ = 0;            // index in its array
  std::uint32_t seen_ = 0;        // one bit per field
  bool in_map_ = false, in_key_ = false, in_array_ = false;
  Problem problem_;
};

/// msgpack's streaming parser, because it keeps its stack; the one-shot function allocates one.
class StatePacketParser::Parser : public msgpack::parser<Parser, void(char*)> {
 public:
  Parser() : msgpack::parser<Parser, void(char*)>(refer, buffer_bytes) {}

  // Required by msgpack::parser.
  [[nodiscard]] Visitor& visitor() { return visitor_; }
  [[nodiscard]] static bool referenced() { return false; }
  static void set_referenced(bool) {}

 private:
  static constexpr std::size_t buffer_bytes = 4 * state_packet_bytes;

  /// Reference counting of the buffer; nothing refers to it.
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
  ended_ = false;
  try {
    ended_ = parser_->next();
  } catch (const msgpack::unpack_error&) {  // an extension longer than memory, where that is 32 bit
  }
  unread_ = parser_->nonparsed_size();
  first_byte_ = static_cast<unsigned char>(packet[0]);
  parser_->skip_nonparsed_buffer(unread_);
  if (!ended_ || unread_ > 0 || !parser_->visitor().complete()) return std::nullopt;
  return parser_->visitor().state();
}

std::string StatePacketParser::problem() const {
  const Visitor& visitor = parser_->visitor();
  if (!visitor.is_map())
    return base::text("it begins with the byte 0x%02x, not with a map", unsigned{first_byte_});
  if (std::string problem = visitor.problem(); !problem.empty()) return problem;
  if (!ended_)
    return "a map that does not end within " + std::to_string(state_packet_bytes) + " bytes";
  if (unread_ > 0)
    return base::text("a map of %zu bytes, LoLA's has %zu", state_packet_bytes - unread_,
                      state_packet_bytes);
  return "a map without " + visitor.missing();
}

}  // namespace gazed::lola
