// Any bytes as the answer to each of the questions that NAOqi is asked, and as a value of a
// signature that is part of them.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <variant>

#include "drivers/naoqi/image_container.hpp"
#include "drivers/naoqi/motion.hpp"

namespace {

using namespace gazed::naoqi;

void walk(const QiValue& value, int depth) {
  if (value.signature == "m") std::abort();  // it must have been unwrapped
  static_cast<void>(value.number());
  static_cast<void>(value.text());
  QiReader elements = value.elements();
  int walked = 0;
  while (const QiValue element = elements.next())
    if (depth < 4 && ++walked <= 8) walk(element, depth + 1);
  if (elements.next()) std::abort();  // after the last one there is none
}

QiResult result_of(QiBytes bytes, std::string_view signature) {
  const QiValue value = QiReader(bytes, signature).next();
  walk(value, 0);
  return {value, "not what it should be"};
}

void check_image(const QiResult& result) {
  const auto image = read_image(result, 4, 2);
  const auto* found = std::get_if<NaoqiImage>(&image);
  if (found == nullptr) return;
  unsigned sum = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 8; ++x) sum += found->image.row(y)[x];
  if (sum > 16 * 255 || found->stamp_us < 0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const QiBytes bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 6) {
    case 0:
      check_image(result_of(bytes, "m"));
      break;
    case 1:
      static_cast<void>(per_joint(result_of(bytes, "[f]")));
      break;
    case 2:
      static_cast<void>(authentication_is_done(result_of(bytes, qi_authenticate.returns).value));
      break;
    case 3:
      static_cast<void>(address_in(result_of(bytes, qi_service.returns).value, {0x7f000001, 9559}));
      break;
    case 4:
      for (const QiMethod& method : motion_methods)
        static_cast<void>(find_method(result_of(bytes, qi_methods.returns).value, method));
      break;
    default: {
      QiReader reader(bytes);
      const std::string_view signature = reader.text();
      static_cast<void>(result_of(reader.rest(), signature));
    }
  }
  return 0;
}
