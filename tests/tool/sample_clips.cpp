#include "sample_clips.h"

#include <algorithm>
#include <sstream>

#include "gait/corpus/corpus.h"
#include "gait/corpus/walk_style.h"
#include "gait/files/bvh.h"

namespace gait::testing {

void write_walk(const std::string& path, const std::string& style, int cycles) {
  const auto& styles = corpus_styles();
  const auto found = std::find_if(styles.begin(), styles.end(),
                                  [&](const WalkStyle& known) { return known.name == style; });
  WalkPlan plan;
  plan.style = *found;
  plan.cycles = cycles;
  write_bvh(bvh_from_clip(make_walk(plan).clip), path);
}

std::string arm_of_a_crane(int frames) {
  std::ostringstream text;
  text << "HIERARCHY\nROOT base\n{\n OFFSET 0 0 0\n CHANNELS 3 Zrotation Xrotation Yrotation\n"
          " JOINT boom\n {\n  OFFSET 0 20 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
          "  JOINT jib\n  {\n   OFFSET 15 5 0\n   CHANNELS 3 Zrotation Xrotation Yrotation\n"
          "   End Site\n   {\n    OFFSET 10 -8 0\n   }\n  }\n }\n}\n"
          "MOTION\nFrames: "
       << frames << "\nFrame Time: 0.04\n";
  for (int frame = 0; frame < frames; ++frame)
    text << "0 0 " << 5 * frame << " " << frame << " 0 0 " << -2 * frame << " 0 0\n";
  return text.str();
}

std::string t_pose_z_up() {
  std::ostringstream text;
  const auto limb = [&](const std::string& first, const std::string& second,
                        const std::string& third, const std::string& start, const std::string& bone,
                        const std::string& end) {
    text << "JOINT " << first << " { OFFSET " << start
         << " CHANNELS 3 Zrotation Xrotation Yrotation\n"
         << "JOINT " << second << " { OFFSET " << bone
         << " CHANNELS 3 Zrotation Xrotation Yrotation\n"
         << "JOINT " << third << " { OFFSET " << bone
         << " CHANNELS 3 Zrotation Xrotation Yrotation\n"
         << "End Site { OFFSET " << end << " } } } }\n";
  };
  text << "HIERARCHY\nROOT Hips { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation "
          "Xrotation Yrotation\n";
  limb("LeftUpLeg", "LeftLeg", "LeftFoot", "4 0 -2", "0 0 -17", "0 -6 -2");
  limb("RightUpLeg", "RightLeg", "RightFoot", "-4 0 -2", "0 0 -17", "0 -6 -2");
  text << "JOINT Spine { OFFSET 0 0 18 CHANNELS 3 Zrotation Xrotation Yrotation\n";
  limb("LeftArm", "LeftForeArm", "LeftHand", "7 0 0", "11 0 0", "5 0 0");
  limb("RightArm", "RightForeArm", "RightHand", "-7 0 0", "-11 0 0", "-5 0 0");
  text << "JOINT Head { OFFSET 0 0 5 CHANNELS 3 Zrotation Xrotation Yrotation\n"
          "End Site { OFFSET 0 0 7 } } } }\nMOTION\nFrames: 1\nFrame Time: 0.0333333\n0 0 38";
  for (int value = 3; value < 6 + 14 * 3; ++value) text << " 0";
  text << "\n";
  return text.str();
}

}  // namespace gait::testing
