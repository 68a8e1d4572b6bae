// The same pixels give the same bits on every target: one committed number per frame and profile.
// A change of the arithmetic changes them; they are then taken from the failure message.
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/saliency/frames.hpp"

namespace gazed {
namespace {

// FNV-1a, 64 bit (Fowler, Noll, Vo), over the samples, low byte first.
std::uint64_t hash_of(const SaliencyMap& map) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint16_t sample : map.samples) {
    for (int byte : {sample & 0xff, sample >> 8}) {
      hash ^= static_cast<std::uint64_t>(byte);
      hash *= 0x100000001b3;
    }
  }
  return hash;
}

struct Expected {
  std::uint64_t report_rgb, report_yuyv, robust_rgb, robust_yuyv;  // 0: no yuyv of odd width
};

const std::map<std::string, Expected>& expected_hashes() {
  static const std::map<std::string, Expected> table{
      {"red disc on a noisy wall",
       {0xcf87f86467e27fb7, 0x9f721e5ac1a8fc59, 0xb51bf3d4655ae649, 0x7dd97e7bd8fbadcc}},
      {"two discs on a shaded wall",
       {0xa0994461fd822865, 0x6dc00a4b91767319, 0x4dacb0c172a1250c, 0x160006ad142cf28c}},
      {"blocks of colour",
       {0x4f9509e499c13624, 0xc7d4f7a74c4024c, 0x59e5e766b4885fd6, 0x4d66d6a3e0c2c467}},
      {"pop-out in hue",
       {0x7d8ad16d8666d929, 0x11f3e0ad1ba35374, 0xc6fd4c9ba8410da3, 0x3814499573612511}},
      {"pop-out in luminance",
       {0x830b945ec9943238, 0xb9aaa78fe107387e, 0xda1d684f2e69fcd0, 0x987411a214b04a63}},
      {"small frame, odd sizes", {0xf88484d26625877a, 0x0, 0xcc861f97e1a7256c, 0x0}},
      {"grey items, 6 levels apart",
       {0xc414809b67bbef3, 0x99b12cf43bb85808, 0xea8870294f472867, 0xd81751913c230a29}},
      {"a touch of red",
       {0xd0ed914c08957d20, 0xe0d903904eab123, 0xea21c9a23e64758a, 0x8fab4d354c368e61}},
      {"a touch of blue",
       {0xd406b0ab8f2f8de0, 0x2d133eeab48cb93a, 0xa9dde3e178f3f086, 0xfa7b29b26a06e03f}},
      {"dark on darker",
       {0xad58e908bfe6cf56, 0x632c4c2553a52854, 0x4bb5c1bb9c71f0b4, 0x5f60512387e5a14e}},
  };
  return table;
}

std::uint64_t look(SaliencyProfile profile, const ImageView& view) {
  SaliencySettings settings;
  settings.profile = profile;
  Saliency saliency(settings, view.width_px, view.height_px);
  return hash_of(saliency.look(view).map);
}

TEST(SaliencyHash, IsWhatWasCommitted) {
  auto all = frames::drawn_frames();
  for (auto& frame : frames::near_grey_displays()) all.push_back(frame);
  for (const frames::NamedFrame& frame : all) {
    const ImageView rgb = frame.canvas.view();
    Expected is{look(SaliencyProfile::report, rgb), 0, look(SaliencyProfile::robust, rgb), 0};
    if (rgb.width_px % 2 == 0) {
      const auto bytes = frames::yuyv_of(rgb);
      const ImageView yuyv = frames::yuyv_view(bytes, rgb.width_px, rgb.height_px);
      is.report_yuyv = look(SaliencyProfile::report, yuyv);
      is.robust_yuyv = look(SaliencyProfile::robust, yuyv);
    }
    const auto row = expected_hashes().find(frame.name);
    const Expected should = row == expected_hashes().end() ? Expected{} : row->second;
    const bool same = is.report_rgb == should.report_rgb && is.report_yuyv == should.report_yuyv &&
                      is.robust_rgb == should.robust_rgb && is.robust_yuyv == should.robust_yuyv;
    EXPECT_TRUE(same) << std::hex << "{\"" << frame.name << "\", {0x" << is.report_rgb << ", 0x"
                      << is.report_yuyv << ", 0x" << is.robust_rgb << ", 0x" << is.robust_yuyv
                      << "}},";
  }
}

}  // namespace
}  // namespace gazed
