#include "pd/models.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/model/model_file.h"
#include "gait/platform/host_process.h"
#include "gait/platform/path_text.h"
#include "pd/worker.h"

namespace gait::pd {

namespace {

// The folder of this library's own file, through whatever link it was loaded.
std::filesystem::path library_folder() {
  static const char here = 0;
  return file_of_code(&here).parent_path();
}

}  // namespace

SharedModel load_model(const std::filesystem::path& path) {
  return make_play_model(read_model(path));
}

SharedModel load_demo_model() {
  const std::filesystem::path file =
      library_folder() / path_from_utf8(std::string(demo_model_name) + ".gait");
  std::error_code failure;
  if (std::filesystem::exists(file, failure)) {
    try {
      return load_model(file);
    } catch (const Error&) {
      // Of another version, or broken: it is made from figures that are in the library itself.
    }
  }
  return make_play_model(make_demo_model());
}

ModelUser::ModelUser(Box& box, std::string name)
    : box_(box),
      name_(name.empty() ? std::string(demo_model_name) : std::move(name)),
      slow_error_(box) {}

ModelUser::~ModelUser() {
  if (info_outlet_) Models::get().remove(this);
}

void ModelUser::join(Outlet& info) {
  info_outlet_ = &info;
  Models::get().add(this);
}

void ModelUser::say_ready() { info_outlet_->add_text(name_).send("ready"); }

bool ModelUser::ready_for_frame() {
  if (model_) return true;
  perf_.drop();
  if (!said_waiting_) logpost(&box_, 2, "%s: waiting for %s", box_.name(), name_.c_str());
  said_waiting_ = true;
  return false;
}

void ModelUser::change(const SharedModel& model, TakeOver take_over) {
  try {
    if (!take_over)
      if (const Prepare make = prepare()) take_over = make(model);
    if (take_over)
      take_over();
    else
      follow(model);
    model_ = model;
    said_waiting_ = false;
  } catch (const std::exception& error) {
    complain(box_, error.what());
  }
}

struct Models::Inside {
  struct Entry {
    SharedModel model;
    std::vector<ModelUser*> users;
    int loading = 0;  // number of the last load that was asked for
    bool busy = false;
  };
  std::map<std::string, Entry> entries;
};

Models::Models() : inside_(new Inside) {}

Models& Models::get() {
  static Models* const models = new Models;
  return *models;
}

SharedModel Models::find(const std::string& name) const {
  const auto at = inside_->entries.find(name);
  return at == inside_->entries.end() ? nullptr : at->second.model;
}

void Models::add(ModelUser* user) {
  Inside::Entry& entry = inside_->entries[user->name_];
  entry.users.push_back(user);
  if (entry.model)
    user->change(entry.model, nullptr);
  else if (user->name_ == demo_model_name)
    want_demo();
}

void Models::want_demo() {
  const std::string name(demo_model_name);
  const Inside::Entry& entry = inside_->entries[name];
  if (entry.model || entry.busy) return;
  load(name, load_demo_model, false, [](const std::string& reason) {
    pd_error(nullptr, "gait: the built-in model cannot be made: %s", reason.c_str());
  });
}

void Models::remove(ModelUser* user) { std::erase(inside_->entries[user->name_].users, user); }

// What the worker made: a model, and what the boxes that used the name at the beginning need.
struct Models::Loaded {
  SharedModel model;
  std::string reason;  // when there is none
  struct User {
    ModelUser* user;
    ModelUser::Prepare prepare;
    ModelUser::TakeOver take_over;
  };
  std::vector<User> users;
};

void Models::publish(const std::string& name, const Loaded& loaded) {
  Inside::Entry& entry = inside_->entries[name];
  SharedModel old = std::move(entry.model);
  entry.model = loaded.model;
  const std::vector<ModelUser*> users = entry.users;
  for (ModelUser* user : users) {
    const auto at = std::ranges::find(loaded.users, user, &Loaded::User::user);
    user->change(entry.model, at == loaded.users.end() ? nullptr : at->take_over);
  }
  for (ModelUser* user : users)
    // What one user sends may make another one go.
    if (std::ranges::find(entry.users, user) != entry.users.end() && user->model_ == loaded.model)
      user->say_ready();
  if (old) Worker::get().free_later(std::move(old));
}

void Models::load(const std::string& name, std::function<SharedModel()> make, bool blocking,
                  std::function<void(const std::string&)> failed) {
  Inside::Entry& entry = inside_->entries[name];
  const int number = ++entry.loading;
  entry.busy = true;
  const auto loaded = std::make_shared<Loaded>();
  for (ModelUser* user : entry.users)
    if (ModelUser::Prepare prepare = user->prepare())
      loaded->users.push_back({user, std::move(prepare), nullptr});
  Worker::get().run(
      [loaded, make = std::move(make)] {
        try {
          loaded->model = make();
        } catch (const std::exception& error) {
          loaded->reason = error.what();
          return;
        }
        for (Loaded::User& user : loaded->users) {
          try {
            user.take_over = user.prepare(loaded->model);
          } catch (const std::exception&) {
            // It will be tried again, and said, when the user takes the model.
          }
        }
      },
      [this, name, number, loaded, failed = std::move(failed)] {
        Inside::Entry& now = inside_->entries[name];
        if (number != now.loading) return;
        now.busy = false;
        if (loaded->model)
          publish(name, *loaded);
        else
          failed(loaded->reason);
      },
      blocking);
}

}  // namespace gait::pd
