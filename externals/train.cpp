// [gait.train NAME]: records takes, learns from them in the background, and gives the model its
// name while everything plays on.
#include <atomic>
#include <cmath>
#include <filesystem>

#include "gait/cancel.h"
#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/model/body_motion.h"
#include "gait/model/model_file.h"
#include "gait/teach/walk_takes.h"
#include "objects.h"
#include "pd/models.h"
#include "pd/ticker.h"
#include "pd/worker.h"
#include "pd/pose_values.h"
#include "train_recorder.h"

namespace gait::pd {

namespace {

constexpr double look_every = 50;  // ms: at the progress
constexpr int most_values = 1000;  // of -in and -out

// What the learning thread and the box share.
struct Learning {
  std::atomic<float> progress{0};
  Cancel stop;
  TakesLearnt learnt;
  SharedModel model;
  std::string reason;  // when it failed
};

std::string label_of(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  if (name.starts_with("walk_")) name.erase(0, 5);
  const std::size_t last = name.rfind('_');
  if (last != std::string::npos && last > 0 &&
      name.find_first_not_of("0123456789", last + 1) == std::string::npos)
    name.erase(last);
  return name;
}

RecordedTake take_of_clip(const std::string& path, const Model& model) {
  const BodyMotion motion = read_motion(path, model);
  PoseValues values(*model.body);
  RecordedTake take{label_of(path), 3 * motion.joints, 0, {}, {}};
  for (int frame = 0; frame < motion.frames(); ++frame) {
    take.seconds.push_back(frame / motion.frame_rate);
    const std::span<const float> pose = values.of(motion.pose(frame));
    take.values.insert(take.values.end(), pose.begin(), pose.end());
  }
  return take;
}

class Train final : public ModelUser {
 public:
  Train(Box& box, const Arguments& arguments)
      : ModelUser(box, named(arguments)),
        cold_(box, this, &take_cold<Train>),
        done_(box),
        info_(box),
        canvas_(canvas_getcurrent()) {
    for (int at = 1; at < arguments.size(); ++at) {
      const std::string flag = arguments.symbol(at);
      if (flag == "-in")
        inputs_ = arguments.integer(++at, 1, most_values);
      else if (flag == "-out")
        outputs_ = arguments.integer(++at, 0, most_values);
      else if (flag == "-blocking")
        blocking_ = true;
      else
        arguments.fail_at(at, "-in, -out or -blocking");
    }
    if (outputs_ > 0 && inputs_ == 0) arguments.fail("expected -in beside -out");
    out_.assign(static_cast<std::size_t>(outputs_), 0);
    given_.assign(static_cast<std::size_t>(inputs_), 0);
    recorder_ = std::make_unique<TakeRecorder>(journal_path(model_name()), blocking_);
    if (!recorder_->left_behind().empty())
      logpost(&box, 2, "gait.train: takes of an earlier session are in %s; 'add' brings them back",
              recorder_->left_behind().c_str());
    join();
  }
  ~Train() override {
    recorder_->stop();  // on disk before the box goes
    if (learning_) learning_->stop.request();
  }

  void in(const Arguments& arguments) {
    if (arguments.selector() == "list" && arguments.size() == 0) return list(arguments);
    if (inputs_ == 0)
      throw Error(
          "gait.train: in: expected 'pose': this box learns walks (-in makes it learn "
          "anything)");
    take_frame(arguments, given_);
  }
  void pose(const Arguments& arguments) {
    if (inputs_ > 0) throw Error("gait.train: pose: expected 'in': this box was made with -in");
    if (!recorder_->recording()) return;
    take_frame(arguments, pose_);
  }

  void record(const Arguments& arguments) {
    arguments.expect_count(1);
    const std::string label = arguments.text(0);
    if (recorder_->recording()) end_take();
    if (inputs_ == 0) {
      if (!body()) {
        logpost(&box(), 2, "gait.train: waiting for gait-demo");
        return;
      }
      pose_.assign(3 * body()->references.size(), 0);
    }
    recorder_->start(label, inputs_ > 0 ? inputs_ : static_cast<int>(pose_.size()), outputs_);
  }
  void stop(const Arguments&) {
    if (!recorder_->recording()) throw Error("gait.train: stop: nothing is being recorded");
    end_take();
  }

  void add(const Arguments& arguments) {
    arguments.expect_count(1);
    char folder[MAXPDSTRING], *file = nullptr;
    const std::string name = arguments.symbol(0);
    const int found = canvas_open(canvas_, name.c_str(), "", folder, &file, MAXPDSTRING, 1);
    if (found < 0)
      throw Error("gait.train: add: no file '" + name + "' beside the patch or on Pd's path");
    sys_close(found);
    const std::string path = std::string(folder) + "/" + file;
    if (inputs_ == 0 && !body()) throw Error("gait.train: add: waiting for gait-demo");
    struct Read {
      std::vector<RecordedTake> takes;
      std::string reason;
    };
    const auto read = std::make_shared<Read>();
    Worker::get().run(
        [read, path, inputs = inputs_, base = inputs_ == 0 ? body_model() : nullptr] {
          try {
            if (path.ends_with(".bvh") || path.ends_with(".BVH")) {
              if (inputs > 0) throw Error("expected a file of takes: this box was made with -in");
              read->takes.push_back(take_of_clip(path, *base->model));
            } else {
              read->takes = read_takes(path);
            }
          } catch (const std::exception& error) {
            read->reason = error.what();
          }
        },
        [this, alive = std::weak_ptr<bool>(alive_), read] {
          if (alive.expired()) return;
          if (!read->reason.empty()) return failed("add: " + read->reason);
          for (RecordedTake& take : read->takes) add_take(std::move(take));
        },
        blocking_);
  }

  void list(const Arguments&) {
    for (std::size_t i = 0; i < recorder_->takes().size(); ++i) tell_take(static_cast<int>(i));
  }
  void remove(const Arguments& arguments) {
    arguments.expect_count(1);
    const int takes = static_cast<int>(recorder_->takes().size());
    if (takes == 0) throw Error("gait.train: remove: there are no takes");
    recorder_->remove(arguments.integer(0, 0, takes - 1));
  }
  void undo(const Arguments&) {
    if (!recorder_->undo()) throw Error("gait.train: undo: there is nothing to undo");
  }

  void train(const Arguments&);
  void cancel(const Arguments&) {
    if (!learning_) throw Error("gait.train: cancel: nothing is being learnt");
    learning_->stop.request();
  }
  void write(const Arguments& arguments) {
    arguments.expect_count(1);
    if (!trained_) throw Error("gait.train: write: expected after 'train'");
    char path[MAXPDSTRING];
    canvas_makefilename(canvas_, arguments.symbol(0).c_str(), path, MAXPDSTRING);
    const auto reason = std::make_shared<std::string>();
    Worker::get().run(
        [reason, to = std::string(path), what = trained_->model] {
          try {
            write_model(*what, to);
          } catch (const std::exception& error) {
            *reason = error.what();
          }
        },
        [this, alive = std::weak_ptr<bool>(alive_), reason, to = std::string(path)] {
          if (alive.expired()) return;
          if (reason->empty())
            info_.add(to).send("written");
          else
            failed("write: " + *reason);
        },
        blocking_);
  }

  void reset(const Arguments&) {
    if (recorder_->recording()) end_take();
  }
  void dump(const Arguments& arguments) { list(arguments); }
  void report_perf(const Arguments&) { perf().report(info_); }
  void print(const Arguments&) {
    post("gait.train: %s: %d takes%s%s", model_name().c_str(),
         static_cast<int>(recorder_->takes().size()), recorder_->recording() ? ", recording" : "",
         learning_ ? ", learning" : "");
  }
  void unknown(const Arguments& arguments) { arguments.fail("no such message"); }

  void cold(const Arguments& arguments) {
    if (arguments.selector() != "out" && arguments.selector() != "list")
      arguments.fail("no such message at the right inlet");
    if (!arguments.read(out_))
      slow_error().say([&] {
        return "gait.train: out: expected " + std::to_string(outputs_) + " numbers, got " +
               std::to_string(arguments.size());
      });
  }

 private:
  static std::string named(const Arguments& arguments) {
    if (arguments.size() == 0) arguments.fail("expected a name for what is learnt");
    const std::string name = arguments.text(0);
    if (name.starts_with('-')) arguments.fail_at(0, "a name for what is learnt");
    if (name == demo_model_name) arguments.fail("expected another name than the built-in model's");
    return name;
  }

  void say_ready() override {
    info_.add_text(model_name()).send("ready");
    if (!tell_done_) return;
    tell_done_ = false;
    done_.add(judged_.accuracy).add(judged_.error).send("done");
  }

  // Poses are of the body of this name's model, when it has one, else of the built-in one.
  SharedModel body_model() {
    if (model() && model()->model->body) return model();
    return Models::get().find(std::string(demo_model_name));
  }
  const Body* body() {
    const SharedModel base = body_model();
    if (!base) Models::get().want_demo();
    return base ? &*base->model->body : nullptr;
  }

  void take_frame(const Arguments& arguments, std::vector<float>& values) {
    if (!arguments.read(values)) {
      perf().drop();
      slow_error().say([&] {
        return "gait.train: " + std::string(arguments.selector()) + ": expected " +
               std::to_string(values.size()) + " numbers, got " + std::to_string(arguments.size());
      });
      return;
    }
    if (!recorder_->recording()) return;
    for (const float value : values)
      if (!std::isfinite(value)) return perf().drop();
    const Perf::Frame frame(perf());
    if (!recorder_->add(clock_gettimesince(0) / 1000, values, out_)) {
      slow_error().say([] { return "gait.train: the take is full (ten minutes) and has ended"; });
      end_take();
    }
  }

  void end_take() {
    if (recorder_->stop())
      tell_take(static_cast<int>(recorder_->takes().size()) - 1);
    else
      logpost(&box(), 2, "gait.train: nothing came while it recorded: no take");
  }
  void add_take(RecordedTake take) {
    const int inputs = inputs_ > 0 ? inputs_ : static_cast<int>(3 * body()->references.size());
    if (take.inputs != inputs || take.outputs != outputs_)
      return failed("add: expected takes with " + std::to_string(inputs) + " values in and " +
                    std::to_string(outputs_) + " out, found " + std::to_string(take.inputs) +
                    " and " + std::to_string(take.outputs));
    recorder_->add_take(std::move(take));
    tell_take(static_cast<int>(recorder_->takes().size()) - 1);
  }
  void tell_take(int index) {
    const RecordedTake& take = *recorder_->takes()[static_cast<std::size_t>(index)];
    info_.add(index).add_text(take.label).add(take.duration()).send("take");
  }
  void failed(const std::string& reason) {
    const std::string line = "gait.train: " + reason;
    say_error(box(), line.c_str());
    info_.add(reason).send("failed");
  }
  void look() {
    if (!learning_) return;
    info_.add(learning_->progress.load()).send("progress");
    ticker_.after(look_every);
  }
  void finish(const std::shared_ptr<Learning>& learning);

  ColdInlet cold_;
  Outlet done_, info_;
  const t_glist* canvas_;
  int inputs_ = 0, outputs_ = 0;
  bool blocking_ = false, tell_done_ = false;
  std::unique_ptr<TakeRecorder> recorder_;
  std::vector<float> given_, pose_, out_;
  std::shared_ptr<Learning> learning_;
  SharedModel trained_;
  TakesJudged judged_;
  Ticker ticker_{[this] { look(); }};
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

void Train::train(const Arguments&) {
  if (learning_) throw Error("gait.train: train: it is learning already ('cancel' stops it)");
  if (recorder_->recording()) end_take();
  if (recorder_->takes().empty())
    throw Error("gait.train: train: there are no takes to learn from");
  const auto learning = std::make_shared<Learning>();
  learning_ = learning;
  ticker_.after(look_every);
  Worker::patient().run(
      [learning, takes = recorder_->takes(), name = model_name(), walks = inputs_ == 0,
       base = inputs_ == 0 ? body_model() : nullptr] {
        try {
          TakeOptions options;
          options.cancel = learning->stop;
          options.progress = [&](double share, const std::string&) {
            learning->progress = static_cast<float>(share);
          };
          if (walks) {
            std::vector<RecordedTake> recorded;
            for (const auto& take : takes) recorded.push_back(*take);
            learning->learnt = learn_walk_takes(recorded, *base->model->body, name, options);
          } else {
            std::vector<Take> even;
            for (const auto& take : takes) even.push_back(at_rate(*take, options.frame_rate));
            learning->learnt = learn_takes(even, options);
            learning->learnt.model.name = name;
          }
          learning->model = make_play_model(std::move(learning->learnt.model));
        } catch (const std::exception& error) {
          learning->reason = error.what();
        }
      },
      [this, alive = std::weak_ptr<bool>(alive_), learning] {
        if (!alive.expired()) finish(learning);
      },
      blocking_);
}

void Train::finish(const std::shared_ptr<Learning>& learning) {
  learning_.reset();
  ticker_.cancel();
  if (!learning->model) return failed(learning->reason);
  info_.add(1).send("progress");
  trained_ = learning->model;
  judged_ = learning->learnt.judged;
  if (judged_.takes > 0 && outputs_ > 0)
    post("gait.train: %s: when a take was left out, what sounds was off by %.2f of its deviation%s",
         model_name().c_str(), judged_.error,
         judged_.error <= 0.25  ? ": good"
         : judged_.error <= 0.6 ? ": more takes would help"
                                : ": it hardly follows from what moves");
  else if (judged_.takes > 0)
    post("gait.train: %s: %s recognised %.0f of 100 times when it was left out%s",
         model_name().c_str(), inputs_ > 0 ? "a take was" : "a step was", 100 * judged_.accuracy,
         judged_.accuracy >= 0.95 ? ": good"
         : judged_.accuracy >= 0.8
             ? ": more takes would help"
             : ": some of these are too much alike, or takes differ too much");
  else
    post("gait.train: %s: learnt; with two takes of each it could say how good it is",
         model_name().c_str());
  tell_done_ = true;
  Models::get().load(
      model_name(), [model = learning->model] { return model; }, blocking_,
      [this, alive = std::weak_ptr<bool>(alive_)](const std::string& reason) {
        if (!alive.expired()) failed(reason);
      });
}

}  // namespace

void setup_train() {
  Class<Train>("gait.train")
      .message<&Train::in>("in")
      .list<&Train::in>()
      .message<&Train::pose>("pose")
      .message<&Train::record>("record")
      .message<&Train::stop>("stop")
      .message<&Train::add>("add")
      .message<&Train::remove>("remove")
      .message<&Train::undo>("undo")
      .message<&Train::train>("train")
      .message<&Train::cancel>("cancel")
      .message<&Train::write>("write")
      .common()
      .anything<&Train::unknown>();
}

}  // namespace gait::pd
