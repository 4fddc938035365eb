#include "skeleton_setting.h"

#include <algorithm>

#include "gait/error.h"
#include "pd/named_argument.h"

namespace gait::pd {

namespace {

constexpr double farthest = 1e5;     // metres
constexpr double fastest_turn = 10;  // rad/s

constexpr std::array<const char*, 3> roots{"feet", "keep", "still"};

}  // namespace

bool SkeletonSetting::take(const Arguments& arguments, BodyStage* stage) {
  if (arguments.selector() == "report")
    take_report(arguments, stage);
  else if (!take_number(arguments))
    return false;
  if (stage) set(*stage);
  return true;
}

bool SkeletonSetting::take_number(const Arguments& arguments) {
  const auto selector = arguments.selector();
  const auto one = [&](double least, double most) {
    return static_cast<float>(arguments.only().number(0, least, most));
  };
  if (selector == "root") {
    const std::string from = arguments.only().symbol(0);
    const auto at = std::ranges::find(roots, from);
    if (at == roots.end()) arguments.fail_at(0, "feet, keep or still");
    root_ = static_cast<RootFrom>(at - roots.begin());
  } else if (selector == "lock") {
    lock_ = arguments.only().flag(0);
  } else if (selector == "heading") {
    heading_ = one(-fastest_turn, fastest_turn);
  } else if (selector == "smooth") {
    smooth_ = one(0, 1000);
  } else if (selector == "leg") {
    leg_ = one(0, 100);
  } else if (selector == "place") {
    arguments.expect_count(3);
    std::array<float, 3> place{};
    for (int i = 0; i < 3; ++i)
      place[static_cast<std::size_t>(i)] =
          static_cast<float>(arguments.number(i, -farthest, farthest));
    place_ = place;
  } else if (selector == "delay") {
    delay_ = arguments.only().integer(0, 0, DelayedFrames::longest_delay);
  } else if (selector == "walking") {
    walking_ = arguments.only().flag(0);
  } else {
    return false;
  }
  return true;
}

SkeletonSetting::Reported SkeletonSetting::found(const Arguments& arguments,
                                                 const BodyStage& stage) {
  Reported joints;
  for (int i = 0; i < arguments.size(); ++i)
    joints.emplace_back(named_argument(arguments, i, stage.model().body->skeleton.joints, "joint"),
                        arguments.text(i));
  return joints;
}

void SkeletonSetting::take_report(const Arguments& arguments, const BodyStage* stage) {
  for (int i = 0; i < arguments.size(); ++i) arguments.text(i);
  if (stage) reported_ = found(arguments, *stage);
  report_.assign(arguments.atoms().begin(), arguments.atoms().end());
}

// Sets all of them: setting the same value again has no effect.
void SkeletonSetting::set(BodyStage& stage) const {
  stage.set_root(root_);
  stage.set_lock(lock_);
  stage.set_heading_rate(heading_);
  stage.set_smooth(smooth_);
  stage.set_leg_length(leg_);
  stage.set_place({place_[0], place_[1], place_[2]});
  stage.set_delay(delay_);
  stage.set_walking(walking_);
}

void SkeletonSetting::apply(BodyStage& stage,
                            const std::function<void(const std::string&)>& failed) {
  set(stage);
  try {
    reported_ = found(
        Arguments("gait.skeleton", "report", static_cast<int>(report_.size()), report_.data()),
        stage);
  } catch (const Error& error) {
    failed(error.what());
    reported_.clear();
    report_.clear();
  }
}

void SkeletonSetting::dump(Outlet& info) const {
  info.add(roots[static_cast<std::size_t>(root_)]).send("root");
  info.add(lock_ ? 1 : 0).send("lock");
  info.add(heading_).send("heading");
  info.add(place_).send("place");
  info.add(smooth_).send("smooth");
  info.add(leg_).send("leg");
  info.add(delay_).send("delay");
  info.add(walking_ ? 1 : 0).send("walking");
  info.add(std::span(report_)).send("report");
}

}  // namespace gait::pd
