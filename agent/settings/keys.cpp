// The rows of the table of keys. Limits without a source are the widest that make sense: they
// catch slips of unit and sign, not of judgement.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "agent/geometry/limits.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/saliency/settings.hpp"
#include "agent/settings/table.hpp"
#include "agent/triangulation/feature_observations.hpp"
#include "drivers/lcm/settings.hpp"

namespace gazed::settings {
namespace {

constexpr double pi_and_a_bit = 3.1416;  // so that the four digits that people write pass

constexpr std::array<std::string_view, 2> positions = {"top", "bottom"};
constexpr std::array<std::string_view, 2> plans = {"report", "parallax"};
constexpr std::array<std::string_view, 2> others = {"hold", "release"};
constexpr std::array<std::string_view, 3> print_formats = {"text", "json", "none"};
constexpr std::array<std::string_view, 3> published_images = {"false", "true", "jpeg"};
constexpr std::array<std::string_view, 3> paces = {"auto", "fast", "real"};

bool is_lcm_url(std::string_view text) {
  const std::size_t colon = text.find("://");
  const std::string_view provider = text.substr(0, colon);
  return colon != std::string_view::npos &&
         (provider == "udpm" ||
          std::ranges::find(lcm::liblcm_providers, provider) != lcm::liblcm_providers.end());
}

bool is_channel_prefix(std::string_view text) {
  constexpr std::size_t longest = 40;  // LCM takes 63 characters; "_LOCATED_POINT" has 14
  const auto fits = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && text.size() <= longest && std::ranges::all_of(text, fits);
}

bool is_any_text(std::string_view) {
  return true;
}

constexpr Range looks_range{triangulation::looks_min,
                            static_cast<double>(triangulation::looks_max)};
constexpr TextRule url_rule{
    "udpm://ADDRESS:PORT?ttl=N or another of LCM's (mpudpm, tcpq, memq, file)", is_lcm_url};
constexpr TextRule prefix_rule{"1 to 40 letters, digits and _", is_channel_prefix};
constexpr TextRule channel_rule{lcm::channel_name_rule, lcm::is_channel_name};
constexpr TextRule scene_rule{"a file name, or empty for the built-in scene", is_any_text};
constexpr TextRule record_rule{"a file name, or empty for none", is_any_text};
constexpr TextRule text_rule{"text, or empty", is_any_text};

Numbers xyz(Eigen::Vector3d& v) {
  return {{&v.x(), &v.y(), &v.z()}, 3};
}

constexpr std::array keys = std::to_array<Key>({
    {"robot", "", "profile that sets every default below",
     [](Settings& s) -> Slot { return &s.robot; }, geometry::robot_names},

    {"camera.source", "", "where frames come from",
     [](Settings& s) -> Slot { return &s.camera.source; }, drivers::Part::camera},
    {"camera.position", "", "which of the head's two cameras",
     [](Settings& s) -> Slot { return &s.camera.position; }, positions},
    {"camera.width_px", "px", "image width",
     [](Settings& s) -> Slot { return &s.rig.camera.width_px; }, saliency::frame_width_range_px},
    {"camera.height_px", "px", "image height",
     [](Settings& s) -> Slot { return &s.rig.camera.height_px; }, saliency::frame_height_range_px},
    {"camera.focal_px", "px", "focal length, [fx, fy]",
     [](Settings& s) -> Slot {
       return Numbers{{&s.rig.camera.focal_px.x(), &s.rig.camera.focal_px.y()}, 2};
     },
     Range{10, 10000}},
    {"camera.centre_px", "px", "principal point, [cx, cy]",
     [](Settings& s) -> Slot {
       return Numbers{{&s.rig.camera.centre_px.x(), &s.rig.camera.centre_px.y()}, 2};
     },
     Range{0, 2559}},
    {"camera.distortion", "", "Brown-Conrady, [k1, k2, p1, p2, k3]",
     [](Settings& s) -> Slot {
       auto& d = s.rig.camera.distortion;
       return Numbers{{&d[0], &d[1], &d[2], &d[3], &d[4]}, 5, 4};
     },
     Range{-10, 10}},
    {"camera.mount_offset_m", "m", "from the joint axes to the camera, head frame, [x, y, z]",
     [](Settings& s) -> Slot { return xyz(s.rig.head.mount_offset_m); }, Range{-1, 1}},
    {"camera.mount_rotation_rad", "rad", "of the camera in the head frame, [roll, pitch, yaw]",
     [](Settings& s) -> Slot { return xyz(s.rig.head.mount_rotation_rad); },
     Range{-pi_and_a_bit, pi_and_a_bit}},
    {"camera.readout_s", "s", "rolling shutter, first row to last",
     [](Settings& s) -> Slot { return &s.cycle.camera.readout_s; }, Range{0, 1}},
    {"camera.delay_s", "s", "added to a time stamp to give the start of exposure",
     [](Settings& s) -> Slot { return &s.cycle.camera.delay_s; }, Range{-1, 1}},
    {"camera.timeout_s", "s", "this long without a frame: CAMERA_FAULT",
     [](Settings& s) -> Slot { return &s.cycle.camera.timeout_s; }, Range{0.1, 60}},
    {"camera.first_frames_dropped", "", "v4l2: frames that are dropped after the stream begins",
     [](Settings& s) -> Slot { return &s.camera.first_frames_dropped; }, Range{0, 300}},

    // Ranges of the V6's camera (B-Human 2024, NaoCamera.cpp); the V5's are narrower, and its
    // driver says so.
    {"camera.controls.auto_exposure", "", "the camera chooses the exposure",
     [](Settings& s) -> Slot { return &s.camera.controls.auto_exposure; }},
    {"camera.controls.exposure", "", "exposure, the camera's own unit",
     [](Settings& s) -> Slot { return &s.camera.controls.exposure; }, Range{0, 1048575}},
    {"camera.controls.gain", "", "gain, the camera's own unit",
     [](Settings& s) -> Slot { return &s.camera.controls.gain; }, Range{0, 1023}},
    {"camera.controls.auto_white_balance", "", "the camera chooses the white balance",
     [](Settings& s) -> Slot { return &s.camera.controls.auto_white_balance; }},
    {"camera.controls.white_balance", "K", "white balance",
     [](Settings& s) -> Slot { return &s.camera.controls.white_balance; }, Range{0, 20000}},
    {"camera.controls.auto_focus", "", "the camera chooses the focus, and focal_px drifts",
     [](Settings& s) -> Slot { return &s.camera.controls.auto_focus; }},
    {"camera.controls.focus", "", "focus, the camera's own unit, 0 is infinity",
     [](Settings& s) -> Slot { return &s.camera.controls.focus; }, Range{0, 1023}},
    {"camera.controls.flip_horizontal", "", "left and right exchanged by the camera",
     [](Settings& s) -> Slot { return &s.camera.controls.flip_horizontal; }},
    {"camera.controls.flip_vertical", "", "top and bottom exchanged by the camera",
     [](Settings& s) -> Slot { return &s.camera.controls.flip_vertical; }},

    {"head.source", "", "what moves and measures the head",
     [](Settings& s) -> Slot { return &s.head.source; }, drivers::Part::head},
    {"head.neck_offset_m", "m", "from the torso's origin to the joint axes, [x, y, z]",
     [](Settings& s) -> Slot { return xyz(s.rig.head.neck_offset_m); }, Range{-1, 1}},
    {"head.zero_rad", "rad", "added to what the sensor says, [yaw, pitch]",
     [](Settings& s) -> Slot {
       return Numbers{{&s.rig.head.zero.yaw_rad, &s.rig.head.zero.pitch_rad}, 2};
     },
     Range{-0.5, 0.5}},
    {"head.margin_rad", "rad", "kept from every joint limit",
     [](Settings& s) -> Slot { return &s.cycle.motion.margin_rad; },
     Range{0, geometry::max_margin_rad}},
    {"head.speed_fraction", "", "speed, of each joint's greatest",
     [](Settings& s) -> Slot { return &s.cycle.motion.speed_fraction; }, Range{0.01, 1}},
    {"head.settle_velocity_rad_s", "rad/s", "slower than this for two samples: still",
     [](Settings& s) -> Slot { return &s.cycle.motion.settle_velocity_rad_s; }, Range{0.001, 10}},
    {"head.settle_tolerance_rad", "rad", "how far from its command a driven head may rest",
     [](Settings& s) -> Slot { return &s.cycle.motion.settle_tolerance_rad; }, Range{0.001, 0.5}},
    {"head.settle_timeout_s", "s", "not settled after this long: HEAD_FAULT",
     [](Settings& s) -> Slot { return &s.cycle.motion.settle_timeout_s; }, Range{0.1, 60}},
    {"head.hold", "", "at the end the head stops where it is",
     [](Settings& s) -> Slot { return &s.head.hold; }},
    {"head.limp_after_kill", "", "--release-head makes it limp; false: it stays as it is",
     [](Settings& s) -> Slot { return &s.head.limp_after_kill; }},
    {"head.other_joints", "", "lola: the body's joints keep what they were found with, or go limp",
     [](Settings& s) -> Slot { return &s.lola.other_joints; }, others},

    {"uncertainty.pixel_sigma_px", "px", "of an image point, per axis",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.pixel_sigma_px; }, Range{0, 100}},
    {"uncertainty.encoder_sigma_rad", "rad", "of a joint angle, per axis and look",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.encoder_sigma_rad; }, Range{0, 1}},
    {"uncertainty.zero_sigma_rad", "rad", "of a joint's zero",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.zero_sigma_rad; }, Range{0, 1}},
    {"uncertainty.focal_sigma_px", "px", "of the focal length",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.focal_sigma_px; }, Range{0, 1000}},
    {"uncertainty.centre_sigma_px", "px", "of the principal point, per axis",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.centre_sigma_px; }, Range{0, 1000}},
    {"uncertainty.distortion_sigma", "", "of the distortion's first two, [k1, k2]",
     [](Settings& s) -> Slot {
       auto& [k1, k2] = s.rig.uncertainty.distortion_sigma;
       return Numbers{{&k1, &k2}, 2};
     },
     Range{0, 1}},
    {"uncertainty.mount_offset_sigma_m", "m", "of the camera's position in the head, per axis",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.mount_offset_sigma_m; }, Range{0, 1}},
    {"uncertainty.mount_rotation_sigma_rad", "rad", "of its orientation in the head, per axis",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.mount_rotation_sigma_rad; }, Range{0, 1}},
    {"uncertainty.torso_rotation_sigma_rad", "rad", "of the torso between two looks, at most",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.torso_rotation_sigma_rad; }, Range{0, 1}},
    {"uncertainty.torso_translation_sigma_m", "m", "of the torso between two looks, at most",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.torso_translation_sigma_m; }, Range{0, 1}},
    {"uncertainty.corner_slip", "",
     "by how much the background's corners tell less than they seem to",
     [](Settings& s) -> Slot { return &s.rig.uncertainty.corner_slip; }, Range{1, 10}},

    {"saliency.profile", "", "the 2011 report's, the one for real pictures, or what is enclosed",
     [](Settings& s) -> Slot { return &s.cycle.saliency.profile; }, saliency::profile_names},
    {"saliency.weights", "", "of the conspicuity maps, [intensity, colour]",
     [](Settings& s) -> Slot {
       return Numbers{{&s.cycle.saliency.intensity_weight, &s.cycle.saliency.colour_weight}, 2};
     },
     saliency::weight_range},
    {"saliency.opponent_weights", "", "of the colour map's parts, [red-green, blue-yellow]",
     [](Settings& s) -> Slot {
       return Numbers{{&s.cycle.saliency.red_green_weight, &s.cycle.saliency.blue_yellow_weight},
                      2};
     },
     saliency::weight_range},
    {"saliency.flicker_weight", "", "of changes while the head is still, beside weights; 0 is off",
     [](Settings& s) -> Slot { return &s.cycle.saliency.flicker_weight; }, saliency::weight_range},
    {"saliency.distinctness_min", "", "below it nothing stands out",
     [](Settings& s) -> Slot { return &s.cycle.saliency.distinctness_min; },
     saliency::distinctness_range},
    {"saliency.intensity_noise_floor", "grey levels", "a map that stays below has no say",
     [](Settings& s) -> Slot { return &s.cycle.saliency.intensity_noise_floor; },
     saliency::noise_floor_range},
    {"saliency.colour_noise_floor", "grey levels", "a map that stays below has no say",
     [](Settings& s) -> Slot { return &s.cycle.saliency.colour_noise_floor; },
     saliency::noise_floor_range},
    {"saliency.flicker_noise_floor", "grey levels", "changes that stay below have no say",
     [](Settings& s) -> Slot { return &s.cycle.saliency.flicker_noise_floor; },
     saliency::noise_floor_range},
    {"saliency.hysteresis", "", "the last winner is left for one greater by this share; 0 is off",
     [](Settings& s) -> Slot { return &s.cycle.saliency.hysteresis; }, saliency::hysteresis_range},
    {"saliency.overexposed_weight", "", "of what is overexposed, as windows are; 1 is all",
     [](Settings& s) -> Slot { return &s.cycle.saliency.overexposed_weight; },
     saliency::overexposed_weight_range},
    {"saliency.exclude_body", "", "the robot's own shoulders and chest are no objects",
     [](Settings& s) -> Slot { return &s.cycle.saliency.exclude_body; }},
    {"saliency.exclude_feet", "", "it stands, and the feet that the bottom camera sees are its own",
     [](Settings& s) -> Slot { return &s.cycle.saliency.exclude_feet; }},
    {"saliency.scan", "", "after each fixation the gaze goes on to another object",
     [](Settings& s) -> Slot { return &s.cycle.saliency.scan; }},
    {"saliency.inhibition_radius_rad", "rad", "scan: around a place looked at, sigma of a Gaussian",
     [](Settings& s) -> Slot { return &s.cycle.saliency.inhibition_radius_rad; },
     saliency::inhibition_radius_range_rad},
    {"saliency.inhibition_decay_s", "s", "scan: after it 37 % of the inhibition are left",
     [](Settings& s) -> Slot { return &s.cycle.saliency.inhibition_decay_s; },
     saliency::inhibition_decay_range_s},
    {"saliency.clamp_negative", "", "report profile: negative colours become 0",
     [](Settings& s) -> Slot { return &s.cycle.saliency.clamp_negative; }},

    {"gaze.move_margin_rad", "rad", "beyond the step rule, so that what is measured keeps it",
     [](Settings& s) -> Slot { return &s.cycle.motion.move_margin_rad; }, Range{0, 0.2}},

    {"locate.method", "", "all looks as one problem, or the report's six steps with two looks",
     [](Settings& s) -> Slot { return &s.cycle.locate.method; }, cycle::locate_method_names},
    {"locate.looks", "", "the most looks at one target, with the first",
     [](Settings& s) -> Slot { return &s.cycle.locate.looks; }, looks_range},
    {"locate.looks_min", "", "the fewest, unless locate.looks is less",
     [](Settings& s) -> Slot { return &s.cycle.locate.looks_min; }, looks_range},
    {"locate.relative_sigma_goal", "", "of the inverse range; from there on no more looks",
     [](Settings& s) -> Slot { return &s.cycle.locate.relative_sigma_goal; }, Range{0, 10}},
    {"locate.relative_sigma_max", "", "of the inverse range; above it a point is UNCERTAIN",
     [](Settings& s) -> Slot { return &s.cycle.locate.gate.relative_sigma_max; }, Range{0.001, 10}},
    {"locate.range_min_m", "m", "nearest range that is searched",
     [](Settings& s) -> Slot { return &s.cycle.locate.registration.range_min_m; },
     Range{0.01, 1000}},
    {"locate.range_max_m", "m", "farthest range that is searched",
     [](Settings& s) -> Slot { return &s.cycle.locate.registration.range_max_m; },
     Range{0.01, 1000}},
    {"locate.plan", "", "what chooses the next look",
     [](Settings& s) -> Slot { return &s.cycle.locate.plan; }, plans},

    {"lcm.url", "", "where messages go", [](Settings& s) -> Slot { return &s.lcm.url; }, url_rule},
    {"lcm.prefix", "", "of every channel's name", [](Settings& s) -> Slot { return &s.lcm.prefix; },
     prefix_rule},
    {"lcm.image_channel", "", "camera lcm or log: frames come here, empty for PREFIX_IMAGE",
     [](Settings& s) -> Slot { return &s.lcm.image_channel; }, channel_rule},
    {"lcm.head_state_channel", "", "head lcm or log: states, empty for PREFIX_HEAD_STATE",
     [](Settings& s) -> Slot { return &s.lcm.head_state_channel; }, channel_rule},
    {"lcm.head_command_channel", "", "head lcm: commands, empty for PREFIX_HEAD_COMMAND",
     [](Settings& s) -> Slot { return &s.lcm.head_command_channel; }, channel_rule},

    {"publish.images", "", "send the frames that were used, as pixels or as JPEG",
     [](Settings& s) -> Slot { return &s.publish.images; }, published_images},
    {"publish.jpeg_quality", "", "of the frames that are sent as JPEG",
     [](Settings& s) -> Slot { return &s.publish.jpeg_quality; }, Range{1, 100}},
    {"publish.images_per_second", "", "the most frames that are sent, 0 is all",
     [](Settings& s) -> Slot { return &s.publish.images_per_second; }, Range{0, 1000}},
    {"publish.saliency", "", "send the saliency map of every view used",
     [](Settings& s) -> Slot { return &s.publish.saliency; }},

    {"run.fixations", "", "end after so many, 0 is never",
     [](Settings& s) -> Slot { return &s.run.fixations; }, Range{0, 1000000000}},
    {"run.print", "", "what is printed for each located point",
     [](Settings& s) -> Slot { return &s.run.print; }, print_formats},
    {"run.record", "", "LCM log that every frame, head state and fixation goes to",
     [](Settings& s) -> Slot { return &s.run.record; }, record_rule},
    {"run.record_keep", "bytes", "beyond it the oldest recordings are removed; 0 keeps all",
     [](Settings& s) -> Slot { return &s.run.record_keep_bytes; }, Range{0, 1e15}},

    {"sim.scene", "", "simulated room and target, TOML",
     [](Settings& s) -> Slot { return &s.sim.scene; }, scene_rule},
    {"sim.seed", "", "of everything random in the simulation",
     [](Settings& s) -> Slot { return &s.sim.seed; }, Range{0, 4294967295}},
    {"sim.pace", "", "of simulated time; auto: fast where run.fixations is set",
     [](Settings& s) -> Slot { return &s.sim.pace; }, paces},

    {"naoqi.user", "", "for a NAOqi that requires authentication",
     [](Settings& s) -> Slot { return &s.naoqi.user; }, text_rule},
    {"naoqi.token", "", "for a NAOqi that requires authentication",
     [](Settings& s) -> Slot { return &s.naoqi.token; }, text_rule},
});

}  // namespace

std::span<const Key> all_keys() {
  return keys;
}

}  // namespace gazed::settings
