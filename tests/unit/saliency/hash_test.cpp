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
  std::uint64_t surround_rgb;
};

const std::map<std::string, Expected>& expected_hashes() {
  static const std::map<std::string, Expected> table{
      {"red disc on a noisy wall",
       {0x1ad9c3cd120f8404, 0x84f0f10b1bcc1480, 0x3a15303c3fec4c30, 0x461ee61ebb1a9448,
        0xc1cb4bdd6885b920}},
      {"two discs on a shaded wall",
       {0x26e87317a41a26b2, 0xd8ec9867fc7e956a, 0x60a092456b4963d7, 0xb1ba09fd59d8ec8b,
        0xbdc54e3c632aad77}},
      {"blocks of colour",
       {0xc2e53651bf2f9942, 0x614993dc1e124b04, 0x6bfa3d2c7144523d, 0x81ca2475ae6d0ea4,
        0x2fc22096c33d4280}},
      {"pop-out in hue",
       {0xac7f6012be764457, 0x7771bf670e6732b4, 0x95f5cd2591968d10, 0xeecc0e726fce73ed,
        0xd8fcbfc56315f716}},
      {"pop-out in luminance",
       {0x224654636dc492f7, 0xdbb9545a6a135edf, 0x1bccbe0b31a47a7b, 0x115880e098d6fc04,
        0x4e2ce2b7942060b0}},
      {"small frame, odd sizes",
       {0xc6eb6b8247ab94c0, 0x0, 0xa34ceec47ecc996c, 0x0, 0x28b3744fac1d0f7b}},
      {"grey items, 6 levels apart",
       {0xd4e421cee70fa43, 0x2d977cde7e604def, 0xff18f5c94c6214fe, 0xeed57ce50b4f37b0,
        0x86b365a707c19bc4}},
      {"a touch of red",
       {0x4fc18c9d4c0205c8, 0x1f45755074423f3e, 0x7cd8d41628fc0760, 0xda81d2d4016e8e53,
        0xa91c0e1944dd4c48}},
      {"a touch of blue",
       {0xdaee79f6464442a1, 0x492e2f7a8eaf5370, 0xd5f4de1d97109889, 0xacd1c3860bd58156,
        0x89032c6481a42222}},
      {"dark on darker",
       {0x66a65a423802b959, 0x37f1c78cba67b9ed, 0xbeffbaade4dc9387, 0x4a41ddde601eaf70,
        0xe9b3b4e798b532fe}},
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
    Expected is{look(SaliencyProfile::report, rgb), 0, look(SaliencyProfile::robust, rgb), 0,
                look(SaliencyProfile::surround, rgb)};
    if (rgb.width_px % 2 == 0) {
      const auto bytes = frames::yuyv_of(rgb);
      const ImageView yuyv = frames::yuyv_view(bytes, rgb.width_px, rgb.height_px);
      is.report_yuyv = look(SaliencyProfile::report, yuyv);
      is.robust_yuyv = look(SaliencyProfile::robust, yuyv);
    }
    const auto row = expected_hashes().find(frame.name);
    const Expected should = row == expected_hashes().end() ? Expected{} : row->second;
    const bool same = is.report_rgb == should.report_rgb && is.report_yuyv == should.report_yuyv &&
                      is.robust_rgb == should.robust_rgb && is.robust_yuyv == should.robust_yuyv &&
                      is.surround_rgb == should.surround_rgb;
    EXPECT_TRUE(same) << std::hex << "{\"" << frame.name << "\", {0x" << is.report_rgb << ", 0x"
                      << is.report_yuyv << ", 0x" << is.robust_rgb << ", 0x" << is.robust_yuyv
                      << ", 0x" << is.surround_rgb << "}},";
  }
}

}  // namespace
}  // namespace gazed
