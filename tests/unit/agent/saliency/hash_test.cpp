// The same pixels give the same bits on every target, map, peak and all: one committed number per
// frame and profile. A change of the arithmetic changes them; they are then taken from the failure
// message.
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/result_hash.hpp"

namespace gazed::saliency::hash_test {
namespace {

struct Expected {
  std::uint64_t report_rgb, report_yuyv, robust_rgb, robust_yuyv;  // 0: no yuyv of odd width
  std::uint64_t surround_rgb, clamped_rgb;                         // clamped: report, its option

  bool operator==(const Expected&) const = default;
};

const std::map<std::string, Expected>& expected_hashes() {
  static const std::map<std::string, Expected> table{
      {"red disc on a noisy wall",
       {0xf18e5c4d3f91d3d6, 0xfb3324fa1b432c82, 0xa80ab5038ac1e58c, 0x3a8315624fb88a3e,
        0xbf2d3ed3f8ea243e, 0xeaf0afea210fd84c}},
      {"two discs on a shaded wall",
       {0x7f7cddf78039dffc, 0x2807d67ac1876eef, 0xea80ba0525b15cda, 0x334ba2eadc5bfa1f,
        0x7e436fa3794df064, 0x78544ad15223ab8f}},
      {"blocks of colour",
       {0x4528feca78f72c3e, 0x1f378c68d2c7ec64, 0xf1b88c43c178de43, 0xbfcf17e0fbe385e8,
        0x259566a7d5164936, 0xd05e9f8d40d74575}},
      {"pop-out in hue",
       {0x6944cfd9463757ef, 0xc85fd532c4af9887, 0xeebdf09a276b0156, 0xc9e451ff54aaf3c8,
        0xb030bce6046fc884, 0xb4ab08abf057c44e}},
      {"pop-out in luminance",
       {0x3cfd75da8e026945, 0x9ce1ae65df9a923d, 0xa8c4288cf3c75ed3, 0x5123ef78aaf42f71,
        0x142885a1f62dd1f6, 0x3cfd75da8e026945}},
      {"small frame, odd sizes",
       {0xf0deda376f2fe319, 0x0, 0xa04e1c495ff9599, 0x0, 0xcd6ff5e96d1f6650, 0xada7dd8eb968e887}},
      {"grey items, 6 levels apart",
       {0x3062124ab1be5e6c, 0xa43d5de15c98b239, 0x5247eb65f249b04c, 0x7c54aa2e87787160,
        0x1792cd56a0295198, 0x3062124ab1be5e6c}},
      {"a touch of red",
       {0x854b637b58167654, 0xd3e3b862b3103bf0, 0x6f7fb86aec3f2dab, 0x54fa800d64ed4167,
        0x7374983d25679da6, 0x112317961d9c6cc4}},
      {"a touch of blue",
       {0x5d07c7cace1f8531, 0x319f8bcc28490308, 0xb49101564daa2014, 0x801a7909931933d3,
        0x2b919561d7df6683, 0x1dc6c2793b88744a}},
      {"dark on darker",
       {0x8ce3e028fb8d8b53, 0x5e16e622e9eb29cd, 0xab79c034b3a45e10, 0x610d6b92b92efff5,
        0x665d5e08ab75f487, 0x97e9f8b7db14c379}},
      {"small frame, even width",
       {0xe366771ba0faa34f, 0xed66214bcc20a8d2, 0xa4943d216b18d1e7, 0x5720e4f7e6ba6f8c,
        0xc7a2a350ef0aeab9, 0x2839baad07f22099}},
  };
  return table;
}

std::uint64_t look(SaliencyProfile profile, const base::ImageView& view,
                   bool clamp_negative = false) {
  SaliencySettings settings;
  settings.profile = profile;
  settings.clamp_negative = clamp_negative;
  Saliency saliency(settings, view.width_px, view.height_px);
  return hash_of(saliency.examine(view));
}

// Its rows of yuyv end within a step of the kernels, which take 32 pixels at a time.
frames::NamedFrame unevenly_wide() {
  return {"small frame, even width",
          frames::Canvas(162, 120, {190, 195, 205}).disc(110, 50, 9, {200, 150, 30}).noise(2, 17)};
}

TEST(SaliencyHash, IsWhatWasCommitted) {
  auto all = frames::drawn_frames();
  for (auto& frame : frames::near_grey_displays()) all.push_back(frame);
  all.push_back(unevenly_wide());
  for (const frames::NamedFrame& frame : all) {
    const base::ImageView rgb = frame.canvas.view();
    Expected is{look(SaliencyProfile::report, rgb),   0,
                look(SaliencyProfile::robust, rgb),   0,
                look(SaliencyProfile::surround, rgb), look(SaliencyProfile::report, rgb, true)};
    if (rgb.width_px % 2 == 0) {
      const auto bytes = frames::yuyv_of(rgb);
      const base::ImageView yuyv = frames::yuyv_view(bytes, rgb.width_px, rgb.height_px);
      is.report_yuyv = look(SaliencyProfile::report, yuyv);
      is.robust_yuyv = look(SaliencyProfile::robust, yuyv);
    }
    const auto row = expected_hashes().find(frame.name);
    const Expected should = row == expected_hashes().end() ? Expected{} : row->second;
    EXPECT_TRUE(is == should) << std::hex << "{\"" << frame.name << "\", {0x" << is.report_rgb
                              << ", 0x" << is.report_yuyv << ", 0x" << is.robust_rgb << ", 0x"
                              << is.robust_yuyv << ", 0x" << is.surround_rgb << ", 0x"
                              << is.clamped_rgb << "}},";
  }
}

}  // namespace
}  // namespace gazed::saliency::hash_test
