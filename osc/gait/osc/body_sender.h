// Body sender: sends poses of a model's body (`root` and `pose` messages) in the form that a
// receiver takes. Nothing allocates after construction.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/humanoid_body.h"
#include "gait/osc/destination.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/rig_sender.h"

namespace gait::osc {

class BodySender {
 public:
  // Throws Error when the model has no body, or no legs where the form is not the project's own.
  BodySender(std::shared_ptr<const Model> model, MocapForm form);

  // `root`: x y z heading; `pose`: three values per joint. Sends to all; returns false when
  // the system refused a packet or the sizes do not fit the model.
  bool send(std::span<const float> root, std::span<const float> pose, double time,
            std::span<const std::shared_ptr<const Destination>> to) noexcept;
  MocapForm form() const noexcept { return form_; }

 private:
  std::shared_ptr<const Model> model_;
  MocapForm form_;
  int hips_ = -1, count_ = 0;
  std::optional<HumanoidBody> body_;
  std::optional<HumanoidSender> humanoid_;
  PoseSender own_;
  HumanoidPose pose_;
  std::vector<Eigen::Quaterniond> local_, world_;
  std::vector<Eigen::Vector3d> translations_, places_;
};

}  // namespace gait::osc
