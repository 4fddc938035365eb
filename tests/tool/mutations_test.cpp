// Two hundred walks, each bent as some exporter bends them, through the whole program: each comes
// out right or is refused with the cause, and none is ruined with exit code 0. GAIT_MUTATIONS sets
// another number of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "gait/corpus/corpus.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"
#include "tool/mutated_walk.h"
#include "tool_runner.h"
#ifdef GAIT_TESTS_OSC
#include "gait/osc/frame_gatherer.h"
#include "gait/osc/receiver.h"
#include "gait/osc/recording.h"
#endif

namespace gait::testing {
namespace {

using Json = nlohmann::json;

constexpr double degrees = 180 / std::numbers::pi;

struct Limb {
  Role from, to;
  const char *bone, *end;  // as VMC names them
};
constexpr Limb limbs[]{{Role::left_thigh, Role::left_shank, "LeftUpperLeg", "LeftLowerLeg"},
                       {Role::left_shank, Role::left_foot, "LeftLowerLeg", "LeftFoot"},
                       {Role::right_thigh, Role::right_shank, "RightUpperLeg", "RightLowerLeg"},
                       {Role::right_shank, Role::right_foot, "RightLowerLeg", "RightFoot"},
                       {Role::left_arm, Role::left_forearm, "LeftUpperArm", "LeftLowerArm"},
                       {Role::left_forearm, Role::left_hand, "LeftLowerArm", "LeftHand"},
                       {Role::right_arm, Role::right_forearm, "RightUpperArm", "RightLowerArm"},
                       {Role::right_forearm, Role::right_hand, "RightLowerArm", "RightHand"}};

// Places of named joints, turned so that Y is up.
class Seen {
 public:
  Seen(const Clip& clip, Eigen::Quaterniond to_y_up, double metres)
      : skeleton_(clip.skeleton), world_(world_poses(clip)), to_y_up_(to_y_up), metres_(metres) {}
  Eigen::Quaterniond turn(int frame, const std::string& name) const {
    const auto joint = static_cast<std::size_t>(skeleton_.find(name));
    return world_.rotations[static_cast<std::size_t>(frame) * skeleton_.joints.size() + joint];
  }
  Eigen::Vector3d at(int frame, const std::string& name) const {
    const int joint = skeleton_.find(name);
    if (joint < 0) return Eigen::Vector3d::Constant(NAN);
    return to_y_up_ *
           world_.positions[static_cast<std::size_t>(frame) * skeleton_.joints.size() + joint] *
           metres_;
  }

 private:
  Skeleton skeleton_;
  WorldPoses world_;
  Eigen::Quaterniond to_y_up_;
  double metres_;
};

// A limb's direction as the body sees it: up is up, its left is left.
Eigen::Vector3d in_body(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& left_thigh, const Eigen::Vector3d& right_thigh) {
  const Eigen::Vector3d across = left_thigh - right_thigh;
  return about_vertical(-std::atan2(-across.z(), across.x())) * (to - from).normalized();
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * degrees;  // NaN stays NaN
}

struct Source {
  Clip clip;
  std::string told;
};

// The project's own walks, and captured ones where they are.
Source source_of(int seed) {
  static const std::vector<std::filesystem::path> captured = [] {
    std::vector<std::filesystem::path> paths;
    for (const char* folder : {"bandai-namco-2", "bandai-namco-1", "cmu-walks"})
      if (std::filesystem::exists(shared_data() / folder))
        for (const auto& entry : std::filesystem::directory_iterator(shared_data() / folder))
          if (entry.path().extension() == ".bvh") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
  }();
  if (seed % 5 == 4 && !captured.empty()) {
    const auto& path = captured[static_cast<std::size_t>(seed) * 7 % captured.size()];
    const Clip in_file = clip_from_bvh(read_bvh(path));
    Clip clip = in_metres_y_up(in_file, guess_body_frame(in_file, find_roles(in_file.skeleton)));
    // Some rigs have a root above the hips that does not move.
    if (clip.skeleton.joints.size() > 1 && find_roles(clip.skeleton).hips == 0)
      return {clip, path.filename().string()};
  }
  const auto& styles = corpus_styles();
  WalkPlan plan;
  plan.style = styles[static_cast<std::size_t>(seed) % styles.size()];
  plan.cycles = 3;
  plan.take = 1 + seed % 3;
  return {make_walk(plan).clip, plan.style.name + " " + std::to_string(plan.take)};
}

class Trial {
 public:
  explicit Trial(int seed)
      : source_(source_of(seed)),
        mutation_(mutated(source_.clip, static_cast<std::uint64_t>(seed))),
        roles_(find_roles(source_.clip.skeleton)),
        truth_(follow_walk(source_.clip, roles_)) {
    walk_ = folder_ / "walk.bvh";
    write_bvh(mutation_.file, walk_);
  }
  std::string told() const { return source_.told + ": " + mutation_.told; }
  int refused() const { return refused_; }

  void run() {
    label();
    if (!train()) return;
    reconstruct();
    render();
    stream();
  }

 private:
  // Whether the program took the walk; if not, it names the file or the joints and why.
  bool taken(const ToolRun& run) {
    if (run.exit_code == 0) return true;
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_NE(run.err.find("expected"), std::string::npos) << told() << ": " << run.err;
    ++refused_;
    why_ = run.err;
    return false;
  }
  double rate() const { return source_.clip.frame_rate * mutation_.frame_factor; }
  Eigen::Vector3d true_place(int frame, Role role) const {
    return truth_.world
        .positions[static_cast<std::size_t>(frame) * source_.clip.skeleton.joints.size() +
                   roles_.joint(role)];
  }
  // A forearm without a hand ends in its tip.
  Eigen::Vector3d true_end(int frame, const Limb& limb) const {
    if (roles_.joint(limb.to) >= 0) return true_place(frame, limb.to);
    const int joint = roles_.joint(limb.from);
    return true_place(frame, limb.from) +
           truth_.world.rotations[static_cast<std::size_t>(frame) *
                                      source_.clip.skeleton.joints.size() +
                                  joint] *
               source_.clip.skeleton.joints[joint].tips.front();
  }
  Eigen::Vector3d true_limb(int frame, const Limb& limb) const {
    return in_body(true_place(frame, limb.from), true_end(frame, limb),
                   true_place(frame, Role::left_thigh), true_place(frame, Role::right_thigh));
  }
  double true_speed() const { return truth_.speed * mutation_.leg_factor * mutation_.frame_factor; }

  void label() {
    const ToolRun run = run_tool({"label", walk_, "--json"});
    if (!taken(run)) return;
    const Json clip = Json::parse(run.out).front();
    const double leg = truth_.leg_length * mutation_.leg_factor;
    EXPECT_NEAR(clip["leg_length"].get<double>() / leg, 1, 0.02);
    EXPECT_NEAR(clip["speed"].get<double>() / true_speed(), 1, 0.03) << run.err;
    EXPECT_TRUE(clip["walking"].get<bool>()) << run.err;
    ASSERT_EQ(clip["contacts"].size(), truth_.contacts.size()) << run.err;
    for (std::size_t i = 0; i < truth_.contacts.size(); ++i) {
      EXPECT_EQ(clip["contacts"][i]["foot"], foot_name(truth_.contacts[i].foot));
      EXPECT_NEAR(clip["contacts"][i]["frame"].get<int>() - mutation_.first_row,
                  truth_.contacts[i].frame, 1);
    }
  }

  bool train() {
    const ToolRun run = run_tool({"train", walk_, "-o", folder_ / "m.gait", "--regularisation",
                                  "30", "--rounds", "0", "--threads", "1"});
    return taken(run);
  }

  void reconstruct() {
    const ToolRun run =
        run_tool({"reconstruct", folder_ / "m.gait", walk_, "-o", folder_ / "found.bvh"});
    if (!taken(run)) return;
    const BvhFile file = read_bvh(folder_ / "found.bvh");
    ASSERT_EQ(file.values.rows(), mutation_.file.values.rows());
    // What was measured is untouched.
    Eigen::Index column = 0;
    for (std::size_t joint = 0; joint < file.channels.size(); ++joint) {
      const auto count = static_cast<Eigen::Index>(file.channels[joint].size());
      for (const Role role : {Role::left_arm, Role::left_forearm, Role::right_arm})
        if (file.skeleton.joints[joint].name == mutation_.names[role]) {
          EXPECT_TRUE(file.values.middleCols(column, count)
                          .isApprox(mutation_.file.values.middleCols(column, count), 1e-6))
              << file.skeleton.joints[joint].name;
        }
      column += count;
    }
    const Seen found(clip_from_bvh(file), mutation_.axes.conjugate(), mutation_.metres_per_unit);
    const int frames = source_.clip.frames(), first = mutation_.first_row;
    std::vector<double> low, knees;
    for (int frame = 0; frame < frames; ++frame) {
      const auto at = [&](Role role) { return found.at(first + frame, mutation_.names[role]); };
      low.push_back(std::min(at(Role::left_foot).y(), at(Role::right_foot).y()) /
                    mutation_.leg_factor);
      for (const auto& [thigh, shank, foot] :
           {std::tuple{Role::left_thigh, Role::left_shank, Role::left_foot},
            {Role::right_thigh, Role::right_shank, Role::right_foot}}) {
        const double bent = degrees_between((at(shank) - at(thigh)).normalized(),
                                            (at(foot) - at(shank)).normalized());
        const double truly =
            degrees_between((true_place(frame, shank) - true_place(frame, thigh)).normalized(),
                            (true_place(frame, foot) - true_place(frame, shank)).normalized());
        knees.push_back(std::abs(bent - truly));
      }
    }
    const double speed = speed_of(found, first, mutation_.names[Role::hips]) /
                         mutation_.leg_factor / mutation_.frame_factor;
    // Where a model of one captured walk travels by guess, another rate of frames guesses
    // otherwise.
    const double unbent = unbent_speed();
    EXPECT_NEAR(speed / unbent, 1, std::abs(unbent / truth_.speed - 1) < 0.1 ? 0.03 : 0.35);
    std::sort(low.begin(), low.end());
    EXPECT_GT(low[low.size() / 2], -0.02);
    EXPECT_LT(low[low.size() / 2], 0.16);
    double sum = 0;
    for (const double knee : knees) sum += knee;
    EXPECT_LT(sum / static_cast<double>(knees.size()), 8);
  }

  // m/s of the hips from the first contact to the last, at the walk's own rate of frames.
  double speed_of(const Seen& seen, int first, const std::string& hips) const {
    const int begin = truth_.contacts.front().frame, end = truth_.contacts.back().frame;
    Eigen::Vector3d way = seen.at(first + end, hips) - seen.at(first + begin, hips);
    way.y() = 0;
    return way.norm() * source_.clip.frame_rate * mutation_.frame_factor / (end - begin);
  }

  // What the same model and steps make of the walk as it was. A model of six steps may walk slower
  // than it was taught.
  double unbent_speed() {
    static std::map<std::string, double> known;
    if (const auto found = known.find(source_.told); found != known.end()) return found->second;
    const std::string walk = unbent_walk(), model = folder_ / "unbent.gait";
    EXPECT_EQ(run_tool({"train", walk, "-o", model, "--regularisation", "30", "--rounds", "0",
                        "--threads", "1"})
                  .exit_code,
              0);
    EXPECT_EQ(run_tool({"reconstruct", model, walk, "-o", folder_ / "again.bvh"}).exit_code, 0);
    const Seen seen(clip_from_bvh(read_bvh(folder_ / "again.bvh")), Eigen::Quaterniond::Identity(),
                    1);
    const double speed =
        speed_of(seen, 0, source_.clip.skeleton.joints[roles_.hips].name) / mutation_.frame_factor;
    EXPECT_NEAR(speed / truth_.speed, 1, 0.5);
    return known[source_.told] = speed;
  }

  std::string unbent_walk() const {
    write_bvh(bvh_from_clip(source_.clip), folder_ / "unbent.bvh");
    return folder_ / "unbent.bvh";
  }

  // How long the picture of the walk as it was is.
  double unbent_picture() const {
    static std::map<std::string, double> known;
    if (const auto found = known.find(source_.told); found != known.end()) return found->second;
    EXPECT_EQ(run_tool({"render", unbent_walk(), "-o", folder_ / "unbent.svg", "--strobe", "5"})
                  .exit_code,
              0);
    return known[source_.told] = static_cast<double>(bytes_of(folder_ / "unbent.svg").size());
  }

  void render() {
    const ToolRun run = run_tool({"render", walk_, "-o", folder_ / "walk.svg", "--strobe", "5"});
    if (!taken(run)) return;
    const std::string picture = bytes_of(folder_ / "walk.svg");
    EXPECT_EQ(picture.find("nan"), std::string::npos);
    // As the walk itself is drawn, but for the joints that were added or lost.
    EXPECT_NEAR(static_cast<double>(picture.size()) / unbent_picture(), 1, 0.25);
  }

#ifdef GAIT_TESTS_OSC
  class Frames final : public osc::FrameSink {
   public:
    void frame(int, const osc::CapturedFrame& frame) noexcept override { recording.add(frame); }
    osc::Recording recording;
  };

  // What is heard of the walk, at a rate that makes it short; none when it was refused.
  std::optional<osc::Recording> heard_once() {
    osc::Receiver receiver({.port = 0});
    const ToolRun run = run_tool(
        {"stream", walk_, "--to", "localhost:" + std::to_string(receiver.port()), "--fps", "600"});
    if (!taken(run)) return std::nullopt;
    osc::FrameGatherer gatherer(1);
    Frames frames;
    osc::MocapEvent event;
    while (receiver.pop(event)) gatherer.take(event, frames);
    gatherer.end_old(1e300, frames);
    return frames.recording;
  }

  void stream() {
    constexpr int most_tries = 3;  // on a busy machine the system drops packets at such a rate
    std::optional<osc::Recording> recording;
    for (int i = 0; i < most_tries; ++i) {
      recording = heard_once();
      if (!recording) return;
      if (recording->frames() == source_.clip.frames()) break;
    }
    ASSERT_GT(recording->frames(), 0);
    const Clip clip = recording->clip("heard");
    ASSERT_EQ(clip.frames(), source_.clip.frames());
    const Seen heard(clip, Eigen::Quaterniond::Identity(), 1);
    for (const Limb& limb : limbs) {
      double farthest = 0;
      for (int frame = 0; frame < clip.frames(); ++frame) {
        const Eigen::Vector3d begin = heard.at(frame, limb.bone);
        // Without a hand the forearm's turn from the T-pose says where it points.
        const bool is_forearm = limb.from == Role::left_forearm || limb.from == Role::right_forearm;
        const double side = limb.from == Role::left_forearm ? 1 : -1;
        const Eigen::Vector3d end =
            is_forearm && roles_.joint(limb.to) < 0
                ? begin + heard.turn(frame, limb.bone) * Eigen::Vector3d(side, 0, 0)
                : heard.at(frame, limb.end);
        const double off = degrees_between(
            true_limb(frame, limb),
            in_body(begin, end, heard.at(frame, "LeftUpperLeg"), heard.at(frame, "RightUpperLeg")));
        farthest = off <= farthest ? farthest : off;  // NaN: not sent
      }
      EXPECT_LT(farthest, 1) << limb.bone;
    }
  }
#else
  void stream() {}
#endif

  TestFolder folder_;
  std::string walk_;
  Source source_;
  Mutation mutation_;
  JointRoles roles_;
  WalkTrack truth_;
  int refused_ = 0;
  std::string why_;
};

TEST(Mutations, come_out_right_or_are_refused_and_none_is_ruined) {
  const char* more = std::getenv("GAIT_MUTATIONS");
  const int count = more != nullptr ? std::atoi(more) : 200;
  const char* from = std::getenv("GAIT_MUTATIONS_FROM");
  const int first = from != nullptr ? std::atoi(from) : 0;
  int refused = 0;
  for (int seed = first; seed < first + count; ++seed) {
    Trial trial(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + trial.told());
    trial.run();
    refused += trial.refused();
  }
  // A program that refused everything would pass as well.
  EXPECT_LT(refused, count / 4 + 1);
  std::printf("%d mutations, %d commands refused\n", count, refused);
}

}  // namespace
}  // namespace gait::testing
