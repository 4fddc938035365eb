#include "bvh_voice.h"

#include "gait/corpus/demo_model.h"
#include "gait/corpus/demo_motion.h"
#include "gait/corpus/walk_style.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/platform/path_text.h"
#include "pd/files.h"
#include "pd/voice_message.h"

namespace gait::pd {

namespace {

constexpr double fastest = 16;        // times, forwards or backwards
constexpr double longest_loop = 1e6;  // seconds

// The walk of a performer whose box names no clip: each performer has another style.
std::string built_in_walk(int number) {
  const auto& styles = corpus_styles();
  const std::size_t voice = number < 0 ? 0 : static_cast<std::size_t>(number);
  return std::string(demo_model_name) + ":" + styles[voice % styles.size()].name + ":" +
         std::to_string(1 + voice / styles.size());
}

}  // namespace

BvhVoice::BvhVoice(const Around& around, int number, const std::string& clip)
    : around_(around), number_(number), clip_(clip), implied_(clip.empty()) {
  background_.set_blocking(around.blocking);
  if (implied_) clip_ = built_in_walk(number);
}

void BvhVoice::take(const SharedModel& model) {
  auto player = std::make_unique<ClipPlayer>(model->model);
  auto recorder = std::make_unique<BvhRecorder>(model->model);
  const double now = player_ ? player_->frame().time : 0;
  model_ = model;
  player_ = std::move(player);
  recorder_ = std::move(recorder);
  clock_.set_period(1000 / model->model->frame_rate);
  player_->set_speed(speed_);
  if (loop_values_ == 2)
    player_->set_loop(loop_begin_, loop_end_);
  else
    player_->set_loop(loop_values_ == 1);
  // A recording is kept when the new body has as many joints; files are read again for the body.
  if (recorded_ && !player_->set_motion(recorded_)) recorded_ = nullptr;
  if (!recorded_) {
    player_->set_motion(opened_);
    load_clip();
  }
  player_->go_to(now);
}

void BvhVoice::say_ready(const std::string& model) {
  to(around_.info, "ready").add_text(model).send();
}

void BvhVoice::load_clip() {
  load([model = model_->model, name = clip_] { return motion_named(name, *model); }, false);
}

void BvhVoice::load(std::function<BodyMotion()> make, bool recording) {
  const int number = ++loads_;
  background_.run([make = std::move(make)] { return std::make_shared<const BodyMotion>(make()); },
                  [this, recording, number](std::shared_ptr<const BodyMotion> motion) {
                    if (number != loads_) return;
                    for (const std::string& warning : motion->warnings)
                      logpost(&around_.box, 2, "%s: %s", around_.box.name(), warning.c_str());
                    (recording ? recorded_ : opened_) = motion;
                    if (!recording) recorded_ = nullptr;
                    play(std::move(motion));
                  },
                  [this, recording, number](const std::string& reason) {
                    // A model with a body of its own has no built-in walk: no message asked for
                    // one.
                    if (number == loads_ && (recording || !implied_))
                      complain(around_.box, "open: " + reason);
                  });
}

void BvhVoice::play(std::shared_ptr<const BodyMotion> motion) {
  if (!player_->set_motion(std::move(motion))) return;
  go_to(0);
  to(around_.info, "length").add(player_->motion()->length()).send();
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
    to(around_.info, "end").send();
  }
}

void BvhVoice::show() {
  const PlayedFrame& frame = player_->frame();
  to(around_.info, "time").add(frame.time).send();
  if (frame.label != label_sent_) {
    label_sent_ = frame.label;
    VoiceMessage label = to(around_.info, "label");  // without a name between two labels
    if (frame.label >= 0) label.add_text(player_->motion()->labels[frame.label].label);
    label.send();
  }
  for (const bool right : {true, false})
    if (right ? frame.right : frame.left) {
      to(around_.info, "contact").add(right ? "right" : "left").send();
    }
  to(around_.pose, "root").add(std::span(frame.hips.data(), 3)).add(frame.heading).send();
  to(around_.pose, "pose").add(frame.pose).send();
  to(around_.in, "in").add(frame.inputs).send();
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
    go_to(arguments.only().number(0, 0, longest_loop));
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

// Finds the file on Pd's thread, which owns Pd's search path; the worker reads and checks it.
void BvhVoice::open(const Arguments& arguments) {
  std::string name = arguments.only().symbol(0);
  if (!names_demo_motion(name)) {
    const auto path = find_file(around_.canvas, name);
    if (!path) arguments.fail(no_file(name));
    name = *path;
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
  speed_ = arguments.only().number(0, -fastest, fastest);
  if (player_) player_->set_speed(speed_);
}

void BvhVoice::record(const Arguments& arguments) {
  const bool on = arguments.only().flag(0);
  if (on == (recorder_ && recorder_->recording())) return;
  if (!recorder_) arguments.fail("expected after the model is there");
  if (on) return recorder_->start();
  const auto recording = recorder_->stop();
  if (recording->frames() == 0)
    arguments.fail("nothing was recorded: no pose, in or out came in at the right inlet");
  loop_values_ = 1;
  player_->set_loop(true);
  load([recording] { return recording->motion("recorded"); }, true);
}

void BvhVoice::clear(const Arguments& arguments) {
  arguments.expect_count(0);
  if (recorder_) recorder_->clear();
  ++loads_;  // drops a recording that is being made a clip, too
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
  background_.run(
      [motion, model = model_->model, to = path_to_write(around_.canvas, arguments.symbol(0))] {
        write_bvh(bvh_from_clip(clip_of(*motion, *model->body)), path_from_utf8(to));
        return to;
      },
      [this](const std::string& path) { to(around_.info, "written").add(path).send(); },
      [this](const std::string& reason) { complain(around_.box, "write: " + reason); });
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
       loop_values_ > 0 ? ", in a loop" : "", recorder_->recording() ? ", recording" : "");
}

void BvhVoice::dump() {
  if (!implied_) {
    to(around_.info, "open").add(clip_).send();
  }
  to(around_.info, "rate").add(speed_).send();
  VoiceMessage loop = to(around_.info, "loop");
  if (loop_values_ == 2)
    loop.add(loop_begin_).add(loop_end_);
  else
    loop.add(loop_values_);
  loop.send();
}

}  // namespace gait::pd
