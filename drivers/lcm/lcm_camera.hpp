// A camera that another program drives, through LCM: bot_core.image_t on PREFIX_IMAGE.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/camera.hpp"
#include "drivers/clocks.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/intake.hpp"
#include "drivers/lcm/link.hpp"

namespace gazed::lcm {

/// YUYV, UYVY, RGB3, BGR3 and GREY with any row_stride. A message that lies about its sizes, has
/// another size than configured, or goes back in time is refused, counted, and told in health()
/// until a good one comes.
class LcmCamera : public drivers::CameraDriver {
 public:
  /// `link` must outlive the camera.
  LcmCamera(LcmLink& link, const Channels& channels, int width_px, int height_px);

  LcmCamera(const LcmCamera&) = delete;
  LcmCamera& operator=(const LcmCamera&) = delete;

  [[nodiscard]] int descriptor() const override { return link_.descriptor(); }
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override;
  /// Dropped: lost on the way (gaps in the times) or never asked for.
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override { return intake_.refusals().text(); }
  [[nodiscard]] std::string warning() override { return intake_.warning(); }

  /// Messages refused so far.
  [[nodiscard]] std::int64_t refused() const { return intake_.refusals().count(); }

 private:
  LcmLink& link_;
  drivers::Clocks clocks_ = drivers::computers_clocks();
  FrameIntake intake_;
};

}  // namespace gazed::lcm
