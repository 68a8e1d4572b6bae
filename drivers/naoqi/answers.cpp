#include "drivers/naoqi/answers.hpp"

#include <array>
#include <optional>

namespace gazed {

namespace {

std::uint32_t as_u32(const QiValue& value) {
  return QiReader(value.bytes).u32();
}

}  // namespace

bool authentication_is_done(const QiValue& answer) {
  constexpr double done = 3.0;  // an "I" of libqi 4, an "i" of libqi 2.5
  std::array<QiValue, 32> entries;
  const std::size_t count = answer.elements(entries);
  for (std::size_t i = 0; i + 1 < count; i += 2)
    if (entries[i].text() == "__qi_auth_state") return entries[i + 1].number() == done;
  return false;
}

std::variant<QiPlace, std::string> place_in(const QiValue& answer, const Endpoint& reached) {
  constexpr std::string_view tcp = "tcp://";
  std::array<QiValue, 6> info;  // name, number, machine, process, addresses, session
  std::array<QiValue, 32> urls;
  if (answer.elements(info) < info.size()) return "no place in its answer";
  std::optional<Endpoint> best;
  for (const QiValue& url : std::span(urls).first(info[4].elements(urls))) {
    const std::string_view text = url.text().value_or("");
    if (!text.starts_with(tcp)) continue;
    const auto place = parse_endpoint(text.substr(tcp.size()), reached.port);
    // Of another computer, its 127.0.0.1 is not ours.
    if (!place || (place->is_this_computer() && !reached.is_this_computer())) continue;
    if (!best || place->address == reached.address) best = place;
  }
  if (!best) return "lists no address that can be reached from here";
  return QiPlace{as_u32(info[1]), *best};
}

bool find_methods(QiBytes meta_object, std::span<const QiMethod> methods,
                  std::span<std::optional<QiFoundMethod>> found) {
  QiReader reader(meta_object);
  for (std::uint32_t count = reader.u32(); count > 0; --count) {
    reader.u32();  // the number, once more
    std::string_view signature = "(Issss[(ss)]s)";
    const auto info = take_value(reader, signature);
    std::array<QiValue, 4> parts;  // number, what it returns, name, parameters
    if (!info || info->elements(parts) < parts.size()) return false;
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (parts[2].text() != methods[i].name || parts[3].text() != methods[i].parameters) continue;
      found[i] = {as_u32(parts[0]), std::string(parts[1].text().value_or(""))};
    }
  }
  return reader.ok();
}

}  // namespace gazed
