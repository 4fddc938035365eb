// A box that gives a name its model: [gait.model] and [gait.train].
#pragma once

#include <functional>
#include <string>

#include "gait/model/model_file.h"
#include "gait/platform/path_text.h"
#include "pd/background.h"
#include "pd/files.h"
#include "pd/models.h"

namespace gait::pd {

class ModelOwner : public ModelUser {
 protected:
  // The info outlet is made by the class that derives from this; it is used only after that.
  ModelOwner(Box& box, std::string name, Outlet& info)
      : ModelUser(box, std::move(name)), info_(info), patch_(canvas_getcurrent()) {}

  // Makes a model on the worker and gives it to all boxes of this name.
  void load(std::function<SharedModel()> make) {
    Models::get().load(model_name(), std::move(make), background_.blocking(),
                       background_.while_here([this](const std::string& why) { failed(why); }));
  }

  // Writes a model to a file beside the patch; then `written FILE` at the info outlet.
  void write_file(const std::string& name, std::shared_ptr<const Model> what) {
    background_.run(
        [to = path_to_write(patch_, name), what = std::move(what)] {
          write_model(*what, path_from_utf8(to));
          return to;
        },
        [this](const std::string& to) { info_.add(to).send("written"); },
        [this](const std::string& reason) { failed("write: " + reason); });
  }

  // Says so on the console and, as `failed REASON`, at the info outlet.
  void failed(const std::string& reason) {
    complain(box(), reason);
    info_.add(reason).send("failed");
  }

  Background& background() { return background_; }
  const t_glist* patch() const { return patch_; }

 private:
  Outlet& info_;
  const t_glist* patch_;
  Background background_;
};

}  // namespace gait::pd
