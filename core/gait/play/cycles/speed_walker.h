// Speed walker (G04 §4): a walk at any speed from standing to 10 km/h, on legs of any length.
//
// The cycle at V = v / leg length lies on lines through a cycle space; the frequency law turns
// phase (eq. 5). Beyond the paper: the law `feet`, which turns phase as fast as the feet travel;
// walkers between subjects; starting and stopping. Controls may come between any two frames; what
// they change comes about within a step or two, and never jumps.
//
// Units: metres, seconds, radians; V in leg lengths per second. Nothing allocates after
// construction.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gait/motion/steps.h"
#include "gait/play/cycles/cycle_reader.h"
#include "gait/play/cycles/speed_tables.h"

namespace gait {

enum class SpeedLaw {
  fitted,  // what the subject did: a * V^b (G04 eq. 6). Feet may slide or speed may lie
  inman,   // 0.743 * sqrt(V) (eq. 4)
  feet     // the frequency at which the feet travel at the commanded speed
};

// What became of a control.
enum class ControlResult {
  as_given,
  clamped,  // out of range; the nearest possible was taken
  refused   // not finite, unknown, negative weights: nothing changed
};

class SpeedWalker {
 public:
  // Stands as the mean of all subjects, law `feet`.
  explicit SpeedWalker(std::shared_ptr<const SpeedTables> tables);

  // m/s, 0 to 10 km/h, and less where legs are shorter than 0.73 m.
  ControlResult set_speed(float metres_per_second) noexcept;
  // Thigh and shank, 0.3 to 1.5 m. Until it is set, that of the subjects walked as.
  ControlResult set_leg_length(float metres) noexcept;
  void set_own_leg_length() noexcept;
  // One weight per subject, not negative; they are normalised.
  ControlResult set_weights(std::span<const float> weights) noexcept;
  ControlResult set_subject(std::string_view subject) noexcept;  // that one alone
  void set_law(SpeedLaw law) noexcept;

  // Moves on by `seconds` (at most a quarter of one is believed; not finite or negative: none).
  void advance(double seconds) noexcept;
  // Shows the cycle at another phase, 0 to 1 (1 left out): forth and back by hand. False, with
  // nothing changed, for any other number.
  bool scrub(double phase) noexcept;
  // Steps per second from now on, whatever the law says and however the feet slide; 0: the law's
  // again. At most 8.
  ControlResult set_cadence(float steps_per_second) noexcept;
  // All controls are reached at once, without transition: a scene begins.
  void settle() noexcept;
  // Stands still, at once; speed and all other controls stay as they were set.
  void reset() noexcept;

  // Local rotations of the model's body, the hips' with heading out.
  std::span<const Eigen::Quaternionf> pose() const noexcept { return pose_; }
  double phase() const noexcept { return phase_; }           // 0 to 1, 0 at the right contact
  float frequency() const noexcept { return frequency_; }    // cycles per second
  float cadence() const noexcept { return 2 * frequency_; }  // steps per second
  float speed() const noexcept { return speed_per_leg_ * leg_length_; }  // reached by now, m/s
  // The foot that met the ground during the last advance.
  std::optional<Foot> contact() const noexcept { return contact_; }
  float leg_length() const noexcept { return leg_length_; }  // reached by now, metres
  // How much larger this walker is than the model's body: what root and offsets are scaled by.
  float scale() const noexcept { return leg_length_ / tables_->leg_length; }
  bool standing() const noexcept { return speed_per_leg_ == 0; }
  const std::vector<SubjectCyclesOverSpeed>& subjects() const noexcept { return tables_->subjects; }

 private:
  float wanted_speed_per_leg() const noexcept;
  float frequency_by(SpeedLaw law) const noexcept;
  void change_subjects(float most) noexcept;
  void change_leg_length(float most) noexcept;
  void change_speed(float seconds) noexcept;
  void change_law(float most) noexcept;
  float slowest() const noexcept;
  float pace_of(float speed_per_leg) const noexcept;
  float speed_of_pace(float pace) const noexcept;
  void read_pose() noexcept;

  std::shared_ptr<const SpeedTables> tables_;
  CycleReader reader_;
  std::vector<float> weights_, wanted_weights_;  // of subjects, sum 1
  std::array<float, 3> laws_{};                  // weights of laws, sum 1
  SpeedLaw law_ = SpeedLaw::feet;
  float wanted_speed_ = 0;       // m/s
  float wanted_leg_length_ = 0;  // metres; 0: the subjects' own
  float leg_length_ = 0;
  float speed_per_leg_ = 0;  // V
  float gaining_ = 0;        // pace per second
  float frequency_ = 0;
  float cadence_ = 0;  // steps per second, set by hand; 0: not
  double phase_ = 0;
  std::optional<Foot> contact_;
  std::vector<Eigen::Quaternionf> pose_;
};

}  // namespace gait
