#include "drivers/table.hpp"

#include <algorithm>
#include <array>

#include "agent/base/endpoint.hpp"
#include "drivers/naoqi/port.hpp"

namespace gazed::drivers {

namespace {

/// Names would need a lookup, which would block gazed's loop.
bool is_naoqi_address(std::string_view text) {
  return base::parse_endpoint(text, naoqi::naoqi_port).has_value();
}

using enum Argument::Need;

constexpr auto rows = std::to_array<DriverRow>({
    {.name = "sim",
     .forms = "sim",
     .has_camera = true,
     .has_head = true,
     .origin = Origin::simulation},
    {.name = "lcm", .forms = "lcm", .has_camera = true, .has_head = true, .origin = Origin::lcm},
    {.name = "log",
     .forms = "log:FILE",
     .has_camera = true,
     .has_head = true,
     .origin = Origin::recording,
     .argument = {required}},
    {.name = "v4l2",
     .forms = "v4l2, v4l2:DEVICE",
     .has_camera = true,
     .argument = {optional},
     .exclusive = true},
    {.name = "lola",
     .forms = "lola, lola:SOCKET",
     .has_head = true,
     .argument = {optional},
     .exclusive = true},
    {.name = "naoqi",
     .forms = "naoqi, naoqi:ADDRESS, naoqi:ADDRESS:PORT",
     .has_camera = true,
     .has_head = true,
     .argument = {optional, is_naoqi_address},
     .exclusive = true},
});

bool fits(const Argument& rule, bool given, std::string_view argument) {
  if (!given) return rule.need != required;
  return rule.need != none && !argument.empty() &&
         (rule.accepts == nullptr || rule.accepts(argument));
}

}  // namespace

std::span<const DriverRow> all_drivers() {
  return rows;
}

std::string allowed_sources(Part part) {
  std::string text;
  for (const DriverRow& row : rows) {
    if (row.has(part)) text.append(text.empty() ? "" : ", ").append(row.forms);
  }
  return text;
}

std::optional<Source> Source::parse(Part part, std::string_view text) {
  const std::size_t colon = text.find(':');
  const bool given = colon != std::string_view::npos;
  const auto row = std::ranges::find(rows, text.substr(0, colon), &DriverRow::name);
  if (row == rows.end() || !row->has(part)) return std::nullopt;
  if (!fits(row->argument, given, given ? text.substr(colon + 1) : "")) return std::nullopt;
  return Source(*row, std::string(text));
}

std::string Source::argument() const {
  const std::size_t colon = text_.find(':');
  return colon == std::string::npos ? std::string() : text_.substr(colon + 1);
}

}  // namespace gazed::drivers
