// What the style walker walks, judged as a captured walk would be: by the recogniser, by its joints
// and by its feet.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "gait/judge/foot_slide.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/resample.h"
#include "gait/offline/reconstructed_clip.h"
#include "play/body/bends.h"
#include "play/body/sole_height.h"
#include "play/change/joint_motion.h"
#include "play/cycles/styled_walks.h"

namespace gait {
namespace {

using testing::BendRange;
using testing::bends_of;
using testing::captured_walks;
using testing::corpus_walks;
using testing::lowest_points;
using testing::percentile;
using testing::StyledWalks;
using testing::Walked;

double frame_rate(const StyledWalks& walks) { return walks.walks.front().clip.frame_rate; }

Walked walk_of_style(const StyledWalks& walks, int style, double seconds, std::uint64_t seed) {
  StyleWalker walker(walks.model, seed);
  walker.set_style(style);
  const double rate = frame_rate(walks);
  return testing::walked(*walks.model, walker, rate, static_cast<int>(seconds * rate));
}

// Share of the cycles of which the style's mean posterior is the largest.
double recognised(const StyledWalks& walks, const Walked& walked, int style) {
  const Model& model = *walks.model;
  const BodyPoses poses =
      body_poses(resampled(walked.clip, model.frame_rate), *model.body,
                 match_joints(*model.body, walked.clip.skeleton, walked.clip.name), 1.1);
  const ReconstructedClip seen = reconstruct_clip(walks.model, poses, model.frame_rate, "walk", {});
  int right = 0, cycles = 0, begin = -1;
  for (const Contact& contact :
       contacts_at(walked.contacts, model.frame_rate / frame_rate(walks))) {
    if (contact.foot != Foot::right || contact.frame >= seen.style_posteriors.cols()) continue;
    if (begin >= 0) {
      Eigen::Index best = 0;
      seen.style_posteriors.middleCols(begin, contact.frame - begin)
          .rowwise()
          .mean()
          .maxCoeff(&best);
      right += best == style, ++cycles;
    }
    begin = contact.frame;
  }
  EXPECT_GT(cycles, 50);
  return static_cast<double>(right) / cycles;
}

void expect_recognised(const StyledWalks& walks) {
  for (std::size_t style = 0; style < walks.model->styles.size(); ++style) {
    const int index = static_cast<int>(style);
    const double share = recognised(walks, walk_of_style(walks, index, 200, 50 + style), index);
    EXPECT_GE(share, 0.95) << walks.model->styles[style];
    ::testing::Test::RecordProperty("recognised " + walks.model->styles[style],
                                    std::to_string(share));
  }
}

// Angular speed (rad/s) and acceleration (rad/s^2) of every joint, frame by frame.
struct Movement {
  std::vector<double> speed, acceleration;
  void add(const Clip& clip, const std::vector<int>& joints, int frame) {
    const double rate = clip.frame_rate;
    for (const int joint : joints) {
      const auto turned = [&](int at) {
        return Eigen::Vector3d(rate * rotation_vector<double>(clip.pose(at - 1)[joint].conjugate() *
                                                              clip.pose(at)[joint]));
      };
      speed.push_back(turned(frame).norm());
      acceleration.push_back(rate * (turned(frame) - turned(frame - 1)).norm());
    }
  }
};

void expect_smooth_joins(const StyledWalks& walks) {
  const Model& model = *walks.model;
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    Movement captured, joins;
    for (const Walk& walk : walks.walks) {
      if (walk.style != model.styles[style]) continue;
      const std::vector<int> matched = match_joints(*model.body, walk.clip.skeleton, "walk");
      std::vector<int> joints;
      for (const int joint : model.style_space->space.joints) joints.push_back(matched[joint]);
      const WalkTrack track = follow_walk(walk.clip, find_roles(walk.clip.skeleton));
      for (const Cycle& cycle : straight_cycles(track))
        for (int frame = std::max(2, cycle.begin); frame < cycle.end; ++frame)
          captured.add(walk.clip, joints, frame);
    }
    // Ten minutes: of a tenth of that the percentile is uncertain by a tenth.
    const Walked walked = walk_of_style(walks, static_cast<int>(style), 600, 70 + style);
    for (int frame = 2; frame < walked.clip.frames(); ++frame) {
      const double phase = walked.phase[frame], per_frame = phase - walked.phase[frame - 1];
      // From where the next cycle comes in to two frames after it has taken over.
      if (phase >= 0.8 || phase < 2 * per_frame || per_frame < 0)
        joins.add(walked.clip, model.style_space->space.joints, frame);
    }
    EXPECT_LE(percentile(joins.speed, 0.999), 1.1 * percentile(captured.speed, 0.999))
        << model.styles[style];
    EXPECT_LE(percentile(joins.acceleration, 0.999), 1.1 * percentile(captured.acceleration, 0.999))
        << model.styles[style];
  }
}

TEST(StyleWalkerWalks, of_the_built_in_styles_are_recognised) { expect_recognised(corpus_walks()); }

TEST(StyleWalkerWalks, of_captured_styles_are_recognised) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  expect_recognised(captured_walks());
}

TEST(StyleWalkerWalks, of_the_built_in_styles_join_their_cycles_smoothly) {
  expect_smooth_joins(corpus_walks());
}

TEST(StyleWalkerWalks, of_captured_styles_join_their_cycles_smoothly) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  expect_smooth_joins(captured_walks());
}

TEST(StyleWalkerWalks, of_captured_styles_slide_no_more_than_was_captured) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const StyledWalks& walks = captured_walks();
  const JointRoles roles = body_roles(*walks.model->body);
  for (std::size_t style = 0; style < walks.model->styles.size(); ++style) {
    double own = 0;
    int stances = 0;
    for (const Walk& walk : walks.walks) {
      if (walk.style != walks.model->styles[style]) continue;
      const JointRoles clip_roles = find_roles(walk.clip.skeleton);
      for (const double stance :
           foot_slide(walk.clip, clip_roles, follow_walk(walk.clip, clip_roles).contacts).stances)
        own += stance, ++stances;
    }
    const Walked walked = walk_of_style(walks, static_cast<int>(style), 60, style);
    EXPECT_LE(foot_slide(walked.clip, roles, walked.contacts).mean, own / stances)
        << walks.model->styles[style];
  }
}

// The built-in walks' feet do not slide at all, being drawn so; a mean of several poses does, by
// millimetres. Only the drunk walker now and then draws a cycle whose steps no leg of that length
// can stand on.
TEST(StyleWalkerWalks, of_the_built_in_styles_stand_within_a_tenth_of_a_millimetre) {
  const StyledWalks& walks = corpus_walks();
  const JointRoles roles = body_roles(*walks.model->body);
  for (std::size_t style = 0; style < walks.model->styles.size(); ++style) {
    const Walked walked = walk_of_style(walks, static_cast<int>(style), 60, style);
    const double slide = foot_slide(walked.clip, roles, walked.contacts).mean;
    std::printf("%s: %.2f mm a stance\n", walks.model->styles[style].c_str(), slide);
    EXPECT_LT(slide, walks.model->styles[style] == "drunk" ? 2 : 0.1) << walks.model->styles[style];
  }
}

// Accelerations of the hips, m/s², as far as they are of a straight walk.
std::vector<double> pushes(const Clip& clip, const JointRoles& roles, int begin, int end) {
  const WorldPoses world = world_poses(clip);
  const auto hips = [&](int frame) {
    return world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() +
                           static_cast<std::size_t>(roles.hips)];
  };
  std::vector<double> result;
  for (int frame = std::max(2, begin); frame < end; ++frame)
    result.push_back((hips(frame) - 2 * hips(frame - 1) + hips(frame - 2)).norm() *
                     clip.frame_rate * clip.frame_rate);
  return result;
}

// One frame in a thousand of a style's walker against the same of the walks it learnt.
void expect_smooth_roots(const StyledWalks& walks, double share) {
  const Model& model = *walks.model;
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    std::vector<double> captured;
    for (const Walk& walk : walks.walks) {
      if (walk.style != model.styles[style]) continue;
      const JointRoles roles = find_roles(walk.clip.skeleton);
      const auto contacts = follow_walk(walk.clip, roles).contacts;
      if (contacts.size() < 2) continue;
      const auto own = pushes(walk.clip, roles, contacts.front().frame, contacts.back().frame);
      captured.insert(captured.end(), own.begin(), own.end());
    }
    const Walked walked = walk_of_style(walks, static_cast<int>(style), 120, 90 + style);
    const double made = percentile(
                     pushes(walked.clip, body_roles(*model.body),
                            static_cast<int>(walked.clip.frame_rate), walked.clip.frames()),
                     0.999),
                 was = percentile(captured, 0.999);
    std::printf("%s: root pushed by %.1f m/s², captured %.1f\n", model.styles[style].c_str(), made,
                was);
    EXPECT_LT(made, share * was) << model.styles[style];
  }
}

TEST(StyleWalkerWalks, of_captured_styles_move_their_hips_as_smoothly_as_captured) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  expect_smooth_roots(captured_walks(), 1.1);
}

// Drawn hips hardly accelerate at all (2 to 6 m/s²); a walker whose cycles differ must.
TEST(StyleWalkerWalks, of_the_built_in_styles_move_their_hips_smoothly) {
  expect_smooth_roots(corpus_walks(), 2.2);
}

void expect_on_the_ground(const StyledWalks& walks) {
  const JointRoles roles = body_roles(*walks.model->body);
  for (std::size_t style = 0; style < walks.model->styles.size(); ++style) {
    const Walked walked = walk_of_style(walks, static_cast<int>(style), 60, style);
    for (const double height : lowest_points(walked.clip, roles))
      EXPECT_GT(height, -0.01) << walks.model->styles[style];
  }
}

TEST(StyleWalkerWalks, have_no_foot_under_the_ground) {
  expect_on_the_ground(corpus_walks());
  if (std::filesystem::exists(testing::shared_data() / "bandai-namco-2"))
    expect_on_the_ground(captured_walks());
}

// What mixing and chance do stays within the training's range; `tolerance` (radians) is for feet
// that are put back where they stand.
void expect_human_between_styles(const StyledWalks& walks, double tolerance) {
  const Model& model = *walks.model;
  const BendRange seen = bends_of(walks.walks);
  const double rate = frame_rate(walks);
  double beyond = -9;
  for (std::size_t a = 0; a < model.styles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      std::vector<float> weights(model.styles.size(), 0);
      weights[a] = weights[b] = 1;
      for (const float variation : {0.0f, 1.0f}) {
        StyleWalker walker(walks.model, a * 100 + b);
        walker.set_variation(variation);
        walker.set_weights(weights);
        const Walked walked = testing::walked(model, walker, rate, static_cast<int>(12 * rate));
        const std::string pair = model.styles[a] + " and " + model.styles[b];
        BendRange bends;
        bends.see(walked.clip, model.body->roles);
        EXPECT_LE(seen.exceeded_by(bends), tolerance) << pair << ", variation " << variation;
        beyond = std::max(beyond, seen.exceeded_by(bends));
        for (const double height : lowest_points(walked.clip, body_roles(*model.body))) {
          EXPECT_GT(height, -0.01) << pair;
          EXPECT_LT(height, 0.04) << pair;  // no flying
        }
      }
    }
  std::printf("beyond the training's knees and elbows by %.1f degrees at most\n",
              beyond * 180 / M_PI);
}

TEST(StyleWalkerWalks, half_way_between_two_built_in_styles_are_still_human) {
  expect_human_between_styles(corpus_walks(), 0.01);
}

TEST(StyleWalkerWalks, half_way_between_two_captured_styles_are_still_human) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  expect_human_between_styles(captured_walks(), 0.01);
}

// Whatever is asked for: knees never bend the wrong way, no hinge much further than anybody's did.
// (About its own axis it does not at all; elbows turn a little about others.)
void expect_no_broken_knee(const StyledWalks& walks) {
  const Model& model = *walks.model;
  const BendRange seen = bends_of(walks.walks);
  const double rate = frame_rate(walks);
  for (std::size_t style = 0; style < model.styles.size(); ++style)
    for (const auto& [variation, exaggeration] :
         {std::pair(2.0f, 1.0f), {1.0f, 2.0f}, {2.0f, 3.0f}, {1.0f, -1.0f}}) {
      StyleWalker walker(walks.model, style);
      walker.set_style(static_cast<int>(style));
      walker.set_variation(variation);
      walker.set_exaggeration(exaggeration);
      const Walked walked = testing::walked(model, walker, rate, static_cast<int>(20 * rate));
      BendRange bends;
      bends.see(walked.clip, model.body->roles);
      EXPECT_LE(seen.exceeded_by(bends), 0.08)
          << model.styles[style] << ", " << variation << ", " << exaggeration;
      for (const int knee : {0, 1}) {
        EXPECT_GT(bends.least[knee], -0.01) << model.styles[style];
        EXPECT_GT(bends.most[knee], 0.5) << model.styles[style];
      }
    }
}

TEST(StyleWalkerWalks, far_from_what_was_taught_break_no_knee) {
  expect_no_broken_knee(corpus_walks());
  if (std::filesystem::exists(testing::shared_data() / "bandai-namco-2"))
    expect_no_broken_knee(captured_walks());
}

}  // namespace
}  // namespace gait
