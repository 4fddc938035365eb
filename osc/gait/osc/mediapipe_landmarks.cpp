#include "gait/osc/mediapipe_landmarks.h"

#include <cctype>
#include <string>

#include "gait/motion/rotation.h"
#include "gait/motion/turns_from_places.h"

namespace gait::osc {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

enum Landmark {
  nose = 0,
  left_eye = 2,
  right_eye = 5,
  left_ear = 7,
  right_ear = 8,
  left_pinky = 17,
  right_pinky = 18,
  left_index = 19,
  right_index = 20,
  left_heel = 29,
  right_heel = 30,
};

struct JointLandmark {
  int landmark;
  Bone bone;
};
constexpr std::array<JointLandmark, 14> joints{{{11, Bone::left_upper_arm},
                                                {12, Bone::right_upper_arm},
                                                {13, Bone::left_lower_arm},
                                                {14, Bone::right_lower_arm},
                                                {15, Bone::left_hand},
                                                {16, Bone::right_hand},
                                                {23, Bone::left_upper_leg},
                                                {24, Bone::right_upper_leg},
                                                {25, Bone::left_lower_leg},
                                                {26, Bone::right_lower_leg},
                                                {27, Bone::left_foot},
                                                {28, Bone::right_foot},
                                                {31, Bone::left_toes},
                                                {32, Bone::right_toes}}};

// A half turn about X, and back.
Vector3d turned_over(const Vector3d& p) { return {p.x(), -p.y(), -p.z()}; }

// The turn that carries +X onto `x`, and +Z as near to `z` as it can be.
bool frame_of(const Vector3d& x, const Vector3d& z, Quaterniond& turn) noexcept {
  const Vector3d across = x.normalized(), y = z.cross(across);
  if (!(x.norm() > 1e-4) || !(y.norm() > 0.05 * z.norm()) || !(z.norm() > 1e-4)) return false;
  Eigen::Matrix3d axes;
  axes.col(0) = across;
  axes.col(1) = y.normalized();
  axes.col(2) = across.cross(axes.col(1));
  turn = Quaterniond(axes);
  return true;
}

// Unit vectors of a face, from the middle between the ears, and of a hand, from the wrist, metres.
const Vector3d ear(0.075, 0.06, 0), eye(0.032, 0.09, 0.09), nose_tip(0, 0.03, 0.11);
const Vector3d knuckle(0.09, 0, 0.03);
const Vector3d heel(0, -0.08, -0.05), toes(0, -0.08, 0.15);

}  // namespace

int landmark_named(std::string_view name) {
  constexpr std::array<std::string_view, mediapipe_landmarks> names{
      "nose",       "lefteyeinner",  "lefteye",       "lefteyeouter", "righteyeinner",
      "righteye",   "righteyeouter", "leftear",       "rightear",     "mouthleft",
      "mouthright", "leftshoulder",  "rightshoulder", "leftelbow",    "rightelbow",
      "leftwrist",  "rightwrist",    "leftpinky",     "rightpinky",   "leftindex",
      "rightindex", "leftthumb",     "rightthumb",    "lefthip",      "righthip",
      "leftknee",   "rightknee",     "leftankle",     "rightankle",   "leftheel",
      "rightheel",  "leftfootindex", "rightfootindex"};
  std::string letters;
  for (const char c : name)
    if (std::isalpha(static_cast<unsigned char>(c)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (int i = 0; i < mediapipe_landmarks; ++i)
    if (names[static_cast<std::size_t>(i)] == letters) return i;
  return -1;
}

void body_of(const Landmarks& landmarks, HumanoidPose& pose) noexcept {
  pose.clear();
  const auto seen = [&](std::initializer_list<int> all) {
    for (const int landmark : all)
      if (!landmarks.seen[static_cast<std::size_t>(landmark)]) return false;
    return true;
  };
  const auto at = [&](int landmark) {
    return turned_over(landmarks.places[static_cast<std::size_t>(landmark)]);
  };
  const auto set = [&pose](Bone bone, const Quaterniond& turn) {
    pose.turned.set(index_of(bone));
    pose.turns[index_of(bone)] = turn.normalized();
  };
  for (const JointLandmark& joint : joints)
    if (seen({joint.landmark})) {
      pose.placed.set(index_of(joint.bone));
      pose.places[index_of(joint.bone)] = at(joint.landmark);
    }
  const bool ears = seen({left_ear, right_ear});
  const Vector3d between_ears =
      ears ? Vector3d((at(left_ear) + at(right_ear)) / 2) : Vector3d(0, 0, 0);
  if (ears) {
    pose.placed.set(index_of(Bone::head));
    pose.places[index_of(Bone::head)] = between_ears;
  }
  // The ears are no joint: the neck's direction is not known from them. It goes with the trunk.
  const bool head_placed = pose.placed[index_of(Bone::head)];
  pose.placed.reset(index_of(Bone::head));
  turns_from_places(pose);
  pose.placed[index_of(Bone::head)] = head_placed;
  Quaterniond turn;
  if (seen({nose, left_eye, right_eye}) && ears) {
    // The nose is as far below the height of the ears as the eyes are above.
    const Vector3d front = (at(nose) + (at(left_eye) + at(right_eye)) / 2) / 2 - between_ears;
    if (frame_of(at(left_ear) - at(right_ear), front, turn)) set(Bone::head, turn);
  }
  for (const bool left : {true, false}) {
    const Bone hand = left ? Bone::left_hand : Bone::right_hand;
    const Bone foot = left ? Bone::left_foot : Bone::right_foot;
    const Bone shank = left ? Bone::left_lower_leg : Bone::right_lower_leg;
    const int index = left ? left_index : right_index, pinky = left ? left_pinky : right_pinky;
    if (seen({index, pinky}) && pose.placed[index_of(hand)]) {
      const Vector3d along = (at(index) + at(pinky)) / 2 - pose.places[index_of(hand)];
      if (frame_of(left ? along : Vector3d(-along), at(index) - at(pinky), turn)) set(hand, turn);
    }
    const int back = left ? left_heel : right_heel, front = left ? 31 : 32;
    if (seen({back, front}) && pose.turned[index_of(shank)]) {
      const Quaterniond& carried = pose.turns[index_of(shank)];
      set(foot,
          turn_between(carried * Vector3d(0, 0, 1), Vector3d(at(front) - at(back))) * carried);
    }
  }
  if (seen({23, 24})) {
    pose.placed.set(index_of(Bone::hips));
    pose.places[index_of(Bone::hips)] = (at(23) + at(24)) / 2;
  }
}

void landmarks_of(const HumanoidPose& pose, Landmarks& landmarks) noexcept {
  std::array<Vector3d, humanoid_bones> places;
  std::array<Quaterniond, humanoid_bones> turns;
  for (int bone = 0; bone < main_bones; ++bone) {
    const auto at = static_cast<std::size_t>(bone);
    const int above = bone_parent(bone);
    turns[at] = pose.turned[at] ? pose.turns[at]
                : above < 0     ? Quaterniond::Identity()
                                : turns[static_cast<std::size_t>(above)];
    places[at] = pose.placed[at] ? pose.places[at]
                 : above < 0
                     ? usual_offset(bone)
                     : Vector3d(places[static_cast<std::size_t>(above)] +
                                turns[static_cast<std::size_t>(above)] * usual_offset(bone));
  }
  const auto place = [&](Bone bone) { return places[index_of(bone)]; };
  const Vector3d origin = (place(Bone::left_upper_leg) + place(Bone::right_upper_leg)) / 2;
  const auto put = [&](int landmark, const Vector3d& at) {
    landmarks.places[static_cast<std::size_t>(landmark)] = turned_over(at - origin);
    landmarks.seen.set(static_cast<std::size_t>(landmark));
  };
  for (const JointLandmark& joint : joints)
    if (joint.landmark < 31) put(joint.landmark, place(joint.bone));
  const auto beside = [&](Bone bone, const Vector3d& from) {
    return Vector3d(place(bone) + turns[index_of(bone)] * from);
  };
  const auto other_side = [](const Vector3d& p) { return Vector3d(-p.x(), p.y(), p.z()); };
  put(nose, beside(Bone::head, nose_tip));
  for (const int eye_part : {1, 2, 3}) {
    put(eye_part, beside(Bone::head, eye));
    put(eye_part + 3, beside(Bone::head, other_side(eye)));
  }
  put(left_ear, beside(Bone::head, ear));
  put(right_ear, beside(Bone::head, other_side(ear)));
  const Vector3d mouth(0.02, 0, 0.09);
  put(9, beside(Bone::head, mouth));
  put(10, beside(Bone::head, other_side(mouth)));
  const Vector3d little(knuckle.x(), 0, -knuckle.z());
  put(left_index, beside(Bone::left_hand, knuckle));
  put(left_pinky, beside(Bone::left_hand, little));
  put(21, beside(Bone::left_hand, Vector3d(0.04, 0, 0.05)));
  put(right_index, beside(Bone::right_hand, other_side(knuckle)));
  put(right_pinky, beside(Bone::right_hand, other_side(little)));
  put(22, beside(Bone::right_hand, Vector3d(-0.04, 0, 0.05)));
  put(left_heel, beside(Bone::left_foot, heel));
  put(right_heel, beside(Bone::right_foot, heel));
  put(31, beside(Bone::left_foot, toes));
  put(32, beside(Bone::right_foot, toes));
}

}  // namespace gait::osc
