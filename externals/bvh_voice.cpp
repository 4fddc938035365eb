#include "bvh_voice.h"

#include "gait/corpus/demo_model.h"
#include "gait/corpus/demo_motion.h"
#include "gait/corpus/walk_style.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "pd/worker.h"

namespace gait::pd {

namespace {

constexpr double fastest = 16;        // times, forwards or backwards
constexpr double longest_loop = 1e6;  // seconds

// Performers that nobody gave a clip walk in different styles.
std::string built_in_walk(int number) {
  const auto& styles = corpus_styles();
  const std::size_t voice = number < 0 ? 0 : static_cast<std::size_t>(number);
  return std::string(demo_model_name) + ":" + styles[voice % styles.size()].name + ":" +
         std::to_string(1 + voice / styles.size());
}

}  // namespace

BvhVoice::BvhVoice(const Around& around, int number, const std::string& clip)
    : around_(around), number_(number), clip_(clip), implied_(clip.empty()) {
  if (implied_) clip_ = built_in_walk(number);
}

Outlet& BvhVoice::begin(Outlet& outlet, const char* selector) {
  if (number_ >= 0) outlet.add(number_).add(selector);
  return outlet;
}

void BvhVoice::send(Outlet& outlet, const char* selector) {
  outlet.send(number_ >= 0 ? "list" : selector);
}

void BvhVoice::take(const SharedModel& model) {
  auto player = std::make_unique<ClipPlayer>(model->model);
  auto recorder = std::make_unique<PoseRecorder>(model->model);
  const double now = player_ ? player_->frame().time : 0;
  model_ = model;
  player_ = std::move(player);
  recorder_ = std::move(recorder);
  recording_ = false;
  given_.resize(3 * model->model->body->skeleton.joints.size());
  clock_.set_period(1000 / model->model->frame_rate);
  player_->set_speed(speed_);
  if (loop_values_ == 2)
    player_->set_loop(loop_begin_, loop_end_);
  else
    player_->set_loop(loop_values_ == 1);
  // What was recorded lives on with a body of as many joints; files are read again for the body.
  if (recorded_ && !player_->set_motion(recorded_)) recorded_ = nullptr;
  if (!recorded_) {
    player_->set_motion(opened_);
    load_clip();
  }
  player_->go_to(now);
}

void BvhVoice::say_ready(const std::string& model) {
  begin(around_.info, "ready").add_text(model);
  send(around_.info, "ready");
}

void BvhVoice::load_clip() {
  load([model = model_->model, name = clip_] { return motion_named(name, *model); }, false);
}

void BvhVoice::load(std::function<BodyMotion()> make, bool recording) {
  const auto loaded = std::make_shared<Loaded>();
  Worker::get().run(
      [loaded, make = std::move(make)] {
        try {
          loaded->motion = std::make_shared<const BodyMotion>(make());
        } catch (const std::exception& error) {
          loaded->reason = error.what();
        }
      },
      [this, alive = std::weak_ptr<bool>(alive_), loaded, recording, number = ++loads_] {
        if (alive.expired() || number != loads_) return;
        if (!loaded->motion) {
          if (implied_ && !recording)
            return;  // a body of its own has no built-in walk, and that is no error
          const std::string line = std::string(around_.box.name()) + ": open: " + loaded->reason;
          say_error(around_.box, line.c_str());
          return;
        }
        for (const std::string& warning : loaded->motion->warnings)
          logpost(&around_.box, 2, "%s: %s", around_.box.name(), warning.c_str());
        (recording ? recorded_ : opened_) = loaded->motion;
        if (!recording) recorded_ = nullptr;
        play(loaded->motion);
      },
      around_.blocking);
}

void BvhVoice::play(std::shared_ptr<const BodyMotion> motion) {
  if (!player_->set_motion(std::move(motion))) return;
  go_to(0);
  begin(around_.info, "length").add(player_->motion()->length());
  send(around_.info, "length");
}

void BvhVoice::go_to(double seconds) {
  ended_ = false;
  label_sent_ = -1;
  if (player_) player_->go_to(seconds);
}

void BvhVoice::run(bool on) {
  if (on == clock_.running()) return;
  if (!on) {
    clock_.stop();
    return;
  }
  if (ended_) go_to(speed_ < 0 ? longest_loop : 0);
  clock_.start(model_ ? 1000 / model_->model->frame_rate : 20);
}

void BvhVoice::bang() {
  if (around_.ready()) step();
}

void BvhVoice::step() {
  if (!player_->motion()) {
    around_.perf.drop();
    return;
  }
  bool moved = false;
  {
    const Perf::Frame frame(around_.perf);
    moved = player_->advance();
  }
  if (moved) {
    show();
  } else if (!ended_) {
    ended_ = true;
    clock_.stop();
    begin(around_.info, "end");
    send(around_.info, "end");
  }
}

void BvhVoice::show() {
  const PlayedFrame& frame = player_->frame();
  begin(around_.info, "time").add(frame.time);
  send(around_.info, "time");
  if (frame.label != label_sent_) {
    label_sent_ = frame.label;
    begin(around_.info, "label");  // without a name between two labels
    if (frame.label >= 0) around_.info.add_text(player_->motion()->labels[frame.label].label);
    send(around_.info, "label");
  }
  for (const bool right : {true, false})
    if (right ? frame.right : frame.left) {
      begin(around_.info, "contact").add(right ? "right" : "left");
      send(around_.info, "contact");
    }
  begin(around_.pose, "root").add(std::span(frame.hips.data(), 3)).add(frame.heading);
  send(around_.pose, "root");
  begin(around_.pose, "pose").add(frame.pose);
  send(around_.pose, "pose");
  begin(around_.in, "in").add(frame.inputs);
  send(around_.in, "in");
}

bool BvhVoice::message(const Arguments& arguments) {
  const auto selector = arguments.selector();
  if (selector == "open") {
    open(arguments);
  } else if (selector == "start" || selector == "stop") {
    run(selector == "start");
  } else if (selector == "loop") {
    loop(arguments);
  } else if (selector == "rate") {
    set_rate(arguments);
  } else if (selector == "goto") {
    arguments.expect_count(1);
    go_to(arguments.number(0, 0, longest_loop));
  } else if (selector == "record") {
    record(arguments);
  } else if (selector == "clear") {
    clear(arguments);
  } else if (selector == "write") {
    write(arguments);
  } else if (selector == "reset") {
    go_to(0);
  } else if (selector == "print") {
    print();
  } else if (selector == "dump") {
    dump();
  } else {
    return false;
  }
  return true;
}

// The file is looked for on Pd's thread and its paths, read and checked on the worker.
void BvhVoice::open(const Arguments& arguments) {
  arguments.expect_count(1);
  std::string name = arguments.symbol(0);
  if (!names_demo_motion(name)) {
    char folder[MAXPDSTRING], *file = nullptr;
    const int found = canvas_open(around_.canvas, name.c_str(), "", folder, &file, MAXPDSTRING, 1);
    if (found < 0) arguments.fail("no file '" + name + "' beside the patch or on Pd's path");
    sys_close(found);
    name = std::string(folder) + "/" + file;
  }
  clip_ = name;
  implied_ = false;
  if (model_) load_clip();
}

void BvhVoice::loop(const Arguments& arguments) {
  arguments.expect_count(1, 2);
  if (arguments.size() == 1) {
    loop_values_ = arguments.flag(0) ? 1 : 0;
    if (player_) player_->set_loop(loop_values_ == 1);
    return;
  }
  const double begin = arguments.number(0, 0, longest_loop);
  const double end = arguments.number(1, 0, longest_loop);
  if (end <= begin) arguments.fail_at(1, "an end after the beginning");
  loop_values_ = 2, loop_begin_ = begin, loop_end_ = end;
  if (player_) player_->set_loop(begin, end);
}

void BvhVoice::set_rate(const Arguments& arguments) {
  arguments.expect_count(1);
  speed_ = arguments.number(0, -fastest, fastest);
  if (player_) player_->set_speed(speed_);
}

void BvhVoice::record(const Arguments& arguments) {
  arguments.expect_count(1);
  const bool on = arguments.flag(0);
  if (on == recording_) return;
  if (!recorder_) arguments.fail("expected after the model is there");
  recording_ = on;
  said_full_ = false;
  if (on) {
    recorder_->clear();
    return;
  }
  auto recording = std::make_shared<PoseRecorder::Recording>(recorder_->finish());
  if (recording->frames() == 0)
    arguments.fail("nothing was recorded: no pose, in or out came in at the right inlet");
  loop_values_ = 1;
  player_->set_loop(true);
  load([recording] { return recording->motion("recorded"); }, true);
}

void BvhVoice::clear(const Arguments& arguments) {
  arguments.expect_count(0);
  if (recorder_) recorder_->clear();
  ++loads_;  // a recording that is being made a clip is forgotten as well
  if (!recorded_) return;
  recorded_ = nullptr;
  if (opened_ && player_)
    play(opened_);
  else if (player_)
    player_->set_motion(nullptr);
}

void BvhVoice::write(const Arguments& arguments) {
  arguments.expect_count(1);
  const auto motion = recorded_ ? recorded_ : opened_;
  if (!motion || !model_) arguments.fail("there is no clip to write yet");
  char path[MAXPDSTRING];
  canvas_makefilename(around_.canvas, arguments.symbol(0).c_str(), path, MAXPDSTRING);
  const auto result = std::make_shared<Loaded>();
  Worker::get().run(
      [result, motion, model = model_->model, to = std::string(path)] {
        try {
          write_bvh(bvh_from_clip(clip_of(*motion, *model->body)), to);
        } catch (const std::exception& error) {
          result->reason = error.what();
        }
      },
      [this, alive = std::weak_ptr<bool>(alive_), result, to = std::string(path)] {
        if (alive.expired()) return;
        if (!result->reason.empty()) {
          const std::string line = std::string(around_.box.name()) + ": write: " + result->reason;
          say_error(around_.box, line.c_str());
          return;
        }
        begin(around_.info, "written").add(to);
        send(around_.info, "written");
      },
      around_.blocking);
}

void BvhVoice::cold(const Arguments& arguments) {
  const auto selector = arguments.selector();
  if (selector != "pose" && selector != "in" && selector != "out" && selector != "root")
    arguments.fail("no such message at the right inlet");
  if (!recording_) return;
  if (recorder_->full()) {
    if (!said_full_)
      logpost(&around_.box, 1, "%s: the recording is full after %g s; `record 0` keeps it",
              around_.box.name(), recorder_->frames() / model_->model->frame_rate);
    said_full_ = true;
    return;
  }
  const Body& body = *model_->model->body;
  const std::size_t count = selector == "root"  ? 4
                            : selector == "in"  ? 3 * body.input_joints.size()
                            : selector == "out" ? 3 * body.output_joints.size()
                                                : given_.size();
  const std::span<float> values(given_.data(), count);
  const double now = clock_gettimesince(0) / 1000;
  const bool taken =
      count <= given_.size() && arguments.read(values) &&
      (selector == "root"  ? recorder_->take_root({values[0], values[1], values[2]}, values[3])
       : selector == "in"  ? recorder_->take_inputs(values, now)
       : selector == "out" ? recorder_->take_outputs(values, now)
                           : recorder_->take_pose(values, now));
  if (!taken)
    around_.slow_error.say([&] {
      return std::string(around_.box.name()) + ": " + std::string(selector) + ": expected " +
             std::to_string(count) + " numbers, got " + std::to_string(arguments.size());
    });
}

void BvhVoice::print() const {
  if (!player_ || !player_->motion()) {
    post("%s: no clip yet", around_.box.name());
    return;
  }
  const BodyMotion& motion = *player_->motion();
  post("%s: %s, %d frames, %g per second, %d contacts; at %.3f of %.3f s, rate %g%s%s",
       around_.box.name(), motion.name.c_str(), motion.frames(), motion.frame_rate,
       static_cast<int>(motion.contacts.size()), player_->frame().time, motion.length(), speed_,
       loop_values_ > 0 ? ", in a loop" : "", recording_ ? ", recording" : "");
}

void BvhVoice::dump() {
  if (!implied_) {
    begin(around_.info, "open").add(clip_);
    send(around_.info, "open");
  }
  begin(around_.info, "rate").add(speed_);
  send(around_.info, "rate");
  begin(around_.info, "loop");
  if (loop_values_ == 2)
    around_.info.add(loop_begin_).add(loop_end_);
  else
    around_.info.add(loop_values_);
  send(around_.info, "loop");
}

}  // namespace gait::pd
