#include "drivers/sim/sim_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazed::sim {

namespace {

// Streams of the seed beside those of the joints.
enum Stream : std::uint64_t { pixel_stream = 101, loss_stream, exposure_stream = 104 };

// A head that has turned so far shows the camera something else.
constexpr double another_sight_rad = 0.03;

std::int64_t microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e6));
}

}  // namespace

SimRobot::SimRobot(Scene scene, const geometry::RobotProfile& profile, std::uint64_t seed,
                   std::int64_t start_utime_us)
    : scene_(std::move(scene)),
      robot_(true_robot(scene_, profile)),
      world_(make_world(scene_, 0, robot_)),
      joints_(scene_.joints, profile.max_speed_rad_s, seed, start_utime_us),
      sway_(scene_.sway, seed),
      renderer_(robot_.camera),
      sensor_(robot_.camera.width_px, robot_.camera.height_px, scene_.camera,
              base::Random(seed, pixel_stream).bits()),
      losses_(seed, loss_stream),
      exposure_steps_(seed, exposure_stream),
      row_(3U * static_cast<std::size_t>(robot_.camera.width_px)),
      start_us_(start_utime_us),
      now_us_(start_utime_us),
      test_start_us_(start_utime_us),
      frames_since_us_(start_utime_us),
      next_state_us_(start_utime_us),
      trail_length_(static_cast<std::size_t>(
          std::ceil(scene_.camera.readout_s / (1e-6 * SimJoints::step_us)) + 1.0)) {
  trails_.resize(exposures_kept * trail_length_);
  for (std::size_t test = 1; test < test_count(scene_); ++test)
    static_cast<void>(make_world(scene_, test, robot_));  // fails now rather than later
  renderer_.set_world(world_);
}

void SimRobot::next_test() {
  if (finished_) return;
  ++test_;
  if (test_ == test_count(scene_)) {
    test_ = 0;
    finished_ = !scene_.repeat;
  }
  if (finished_) return;
  world_ = make_world(scene_, test_, robot_);
  renderer_.set_world(world_);
  if (!observed_us_) now_us_ += pause_us;
  test_start_us_ = now_us_;
  if (observed_us_) return;
  joints_.reset(geometry::HeadAngles{}, now_us_);
  frames_since_us_ = next_state_us_ = now_us_;
  frame_ = 0;
}

std::int64_t SimRobot::exposure_start_us() const {
  return frames_since_us_ + microseconds(static_cast<double>(frame_) / scene_.camera.fps);
}

/// A frame is there when its last row is read and its time stamp has come.
std::int64_t SimRobot::delivery_us() const {
  return exposure_start_us() +
         microseconds(std::max(scene_.camera.readout_s, -scene_.camera.delay_s));
}

void SimRobot::skip_lost_frames() {
  for (; !frame_decided_; ++frame_) {
    frame_decided_ = losses_.uniform() >= scene_.camera.drop_rate;
    if (frame_decided_) break;
    ++frames_dropped_;
  }
}

void SimRobot::skip_old_frames() {
  if (!observed_us_) return;
  const std::int64_t late_us = *observed_us_ - delivery_us();
  const auto periods =
      static_cast<std::int64_t>(1e-6 * static_cast<double>(late_us) * scene_.camera.fps);
  if (periods < 2) return;
  frame_ += periods - 1;
  frames_dropped_ += static_cast<std::int32_t>(periods - 1);
}

std::optional<std::int64_t> SimRobot::next_frame_utime_us() {
  if (finished_) return std::nullopt;
  skip_old_frames();
  skip_lost_frames();
  return delivery_us();
}

std::optional<geometry::Frame> SimRobot::next_frame(const drivers::FrameFilter& wanted) {
  if (!wait_for_frame()) return std::nullopt;
  const std::int64_t start_us = exposure_start_us();
  const std::int64_t utime_us = start_us - microseconds(scene_.camera.delay_s);
  const double exposure = exposure_factor(start_us);
  const base::ImageView image =
      wanted(utime_us) ? picture(start_us, exposure) : sensor_.finish_nothing();
  remember_exposure(start_us);
  ++frame_;
  frame_decided_ = false;
  return geometry::Frame{image, utime_us};
}

bool SimRobot::wait_for_frame() {
  const std::optional<std::int64_t> due_us = next_frame_utime_us();
  if (!due_us) return false;
  now_us_ = std::max(now_us_, *due_us);
  if (!observed_us_) joints_.advance_to(*due_us);
  return true;
}

double SimRobot::test_time_s(std::int64_t utime_us) const {
  return 1e-6 * static_cast<double>(utime_us - test_start_us_);
}

double SimRobot::exposure_factor(std::int64_t start_us) {
  const CameraBehaviour& camera = scene_.camera;
  const geometry::HeadAngles angles = joints_.camera_angles(start_us);
  if (geometry::greatest_difference(angles, exposed_at_) > another_sight_rad) {
    exposed_at_ = angles;
    exposure_step_ = camera.exposure_step * exposure_steps_.symmetric();
  }
  const double phase = 2.0 * std::numbers::pi * test_time_s(start_us) / camera.exposure_period_s;
  return camera.exposure * (1.0 + exposure_step_) * (1.0 + camera.exposure_swing * std::sin(phase));
}

geometry::Pose SimRobot::cam_from_room(geometry::HeadAngles angles, std::int64_t utime_us) const {
  const geometry::Pose cam_from_torso = geometry::cam_from_torso(robot_.head, angles);
  if (!sway_.sways()) return cam_from_torso;
  const double time_s = 1e-6 * static_cast<double>(utime_us - start_us_);
  return cam_from_torso * sway_.room_from_torso(time_s).inverse();
}

base::ImageView SimRobot::picture(std::int64_t start_us, double exposure) {
  const bool world_moves = std::any_of(world_.surfaces.begin(), world_.surfaces.end(),
                                       [](const Surface& s) { return s.motion.moves(); });
  const bool never_still = world_moves || sway_.sways();
  const bool moving =
      scene_.camera.readout_s > 0.0 && (never_still || joints_.moved_since(start_us));
  const Sight sight{joints_.camera_angles(start_us), test_, exposure};
  if (rendered_ == sight && !moving) return sensor_.finish_again();
  rendered_.reset();
  if (!moving && !never_still) rendered_ = sight;
  sensor_.set_exposure(sight.exposure);
  render(start_us, moving);
  return sensor_.finish();
}

void SimRobot::render(std::int64_t start_us, bool moving) {
  const int rows = robot_.camera.height_px;
  for (int y = 0; y < rows; ++y) {
    if (y == 0 || moving) {
      const std::int64_t row_us = start_us + microseconds(row_time_s(y));
      renderer_.set_pose(cam_from_room(joints_.camera_angles(row_us), row_us), test_time_s(row_us));
    }
    renderer_.render_row(y, row_);
    sensor_.add_row(row_);
  }
}

std::optional<std::int64_t> SimRobot::next_state_utime_us() const {
  if (finished_) return std::nullopt;
  return next_state_us_;
}

std::optional<geometry::HeadState> SimRobot::next_state() {
  if (finished_) return std::nullopt;
  now_us_ = std::max(now_us_, next_state_us_);
  joints_.advance_to(next_state_us_);
  geometry::HeadState state = joints_.measure();
  state.utime_us = next_state_us_;
  next_state_us_ += state_period_us;
  return state;
}

void SimRobot::observe(const geometry::HeadState& state) {
  joints_.follow(state.measured, state.utime_us);
  if (!observed_us_) test_start_us_ = state.utime_us;
  observed_us_ = state.utime_us;
  now_us_ = std::max(now_us_, state.utime_us);
}

SimTruth SimRobot::truth() const {
  SimTruth truth{test_, robot_.camera, robot_.head, joints_.camera_angles(now_us_),
                 world_at(world_, test_time_s(now_us_)).target_in_torso};
  if (truth.target_in_torso && sway_.sways()) {
    const double time_s = 1e-6 * static_cast<double>(now_us_ - start_us_);
    truth.target_in_torso = sway_.room_from_torso(time_s).inverse() * *truth.target_in_torso;
  }
  return truth;
}

double SimRobot::row_time_s(double row) const {
  return scene_.camera.readout_s * row / (robot_.camera.height_px - 1);
}

void SimRobot::remember_exposure(std::int64_t start_us) {
  const std::size_t place = exposure_count_++ % exposures_kept;
  exposures_[place] = {start_us - microseconds(scene_.camera.delay_s), start_us, test_,
                       test_time_s(start_us)};
  for (std::size_t i = 0; i < trail_length_; ++i)
    trails_[place * trail_length_ + i] =
        joints_.camera_angles(start_us + static_cast<std::int64_t>(i) * SimJoints::step_us);
}

std::optional<std::size_t> SimRobot::exposure(std::int64_t frame_utime_us) const {
  for (std::size_t i = 0; i < std::min(exposure_count_, exposures_kept); ++i)
    if (exposures_[i].utime_us == frame_utime_us) return i;
  return std::nullopt;
}

geometry::HeadAngles SimRobot::angles_after(std::size_t exposure, double time_s) const {
  const geometry::HeadAngles* trail = &trails_[exposure * trail_length_];
  const double steps =
      std::clamp(1e6 * time_s / SimJoints::step_us, 0.0, static_cast<double>(trail_length_ - 1));
  const auto before = static_cast<std::size_t>(steps);
  const geometry::HeadAngles& a = trail[before];
  const geometry::HeadAngles way = trail[std::min(before + 1, trail_length_ - 1)] - a;
  const double share = steps - static_cast<double>(before);
  return a + geometry::HeadAngles{share * way.yaw_rad, share * way.pitch_rad};
}

std::optional<geometry::HeadAngles> SimRobot::true_angles(std::int64_t frame_utime_us,
                                                          double row) const {
  const std::optional<std::size_t> found = exposure(frame_utime_us);
  if (!found) return std::nullopt;
  return angles_after(*found, row_time_s(row));
}

std::optional<Hit> SimRobot::true_hit_in_frame(std::int64_t frame_utime_us,
                                               const geometry::Pixel& pixel) const {
  const std::optional<std::size_t> found = exposure(frame_utime_us);
  if (!found || exposures_[*found].test != test_) return std::nullopt;
  const double after_s = row_time_s(pixel.y());
  return hit(world_at(world_, exposures_[*found].test_time_s + after_s), robot_.camera,
             cam_from_room(angles_after(*found, after_s),
                           exposures_[*found].start_us + microseconds(after_s)),
             pixel);
}

std::optional<Hit> SimRobot::true_hit(geometry::HeadAngles true_angles,
                                      const geometry::Pixel& pixel) const {
  return hit(world_at(world_, test_time_s(now_us_)), robot_.camera,
             cam_from_room(true_angles, now_us_), pixel);
}

std::optional<Hit> SimRobot::true_hit(geometry::HeadAngles true_angles,
                                      const geometry::Pixel& pixel, std::size_t test) const {
  return hit(make_world(scene_, test, robot_), robot_.camera,
             geometry::cam_from_torso(robot_.head, true_angles), pixel);
}

std::optional<double> SimRobot::true_range_m(geometry::HeadAngles true_angles,
                                             const geometry::Pixel& pixel) const {
  const std::optional<Hit> met = true_hit(true_angles, pixel);
  if (!met) return std::nullopt;
  return met->range_m;
}

}  // namespace gazed::sim
