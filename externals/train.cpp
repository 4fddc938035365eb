// [gait.train NAME]: records takes, learns a model from them on the worker, and gives it to all
// boxes of its name while they play.
#include <cmath>

#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/platform/path_text.h"
#include "objects.h"
#include "pd/model_owner.h"
#include "pd/ticker.h"
#include "train_clip.h"
#include "train_learning.h"
#include "train_recorder.h"

namespace gait::pd {

namespace {

constexpr double look_every = 50;   // ms: how often the progress is sent
constexpr double save_every = 400;  // ms: what a sudden end of Pd may cost, and a little more
constexpr int most_values = 1000;   // of -in and -out

class Train final : public ModelOwner {
 public:
  Train(Box& box, const Arguments& arguments)
      : ModelOwner(box, named(arguments), info_),
        cold_(box, this, &take_cold<Train>),
        done_(box),
        info_(box) {
    for (int at = 1; at < arguments.size(); ++at) {
      const std::string flag = arguments.symbol(at);
      if (flag == "-in")
        inputs_ = arguments.integer(++at, 1, most_values);
      else if (flag == "-out")
        outputs_ = arguments.integer(++at, 0, most_values);
      else if (flag == "-blocking")
        background().set_blocking(true);
      else
        arguments.fail_at(at, "-in, -out or -blocking");
    }
    if (outputs_ > 0 && inputs_ == 0) arguments.fail("expected -in beside -out");
    out_.assign(static_cast<std::size_t>(outputs_), 0);
    given_.assign(static_cast<std::size_t>(inputs_), 0);
    recorder_ = std::make_unique<TakeRecorder>(journal_path(model_name()), background().blocking());
    if (!recorder_->left_behind().empty()) {
      logpost(&box, 2,
              "gait.train: takes of an earlier session are in %s; 'restore' brings them back",
              recorder_->left_behind().c_str());
      offer_.after(0);  // when the patch is loaded
    }
    join(info_);
  }
  ~Train() override {
    recorder_->stop();  // on disk before the box goes
    if (learning_) learning_->cancel.request();
  }

  void in(const Arguments& arguments) {
    if (arguments.selector() == "list" && arguments.size() == 0) return list(arguments);
    if (learns_walks())
      throw Error(
          "gait.train: in: expected 'pose': this box learns walks (-in makes it learn "
          "anything)");
    take_frame(arguments, given_);
  }
  // A phone's stream from [gait.osc], with its name first.
  void plain(const Arguments& arguments) {
    if (arguments.size() < 1) arguments.fail("expected a name and numbers");
    const auto atoms = arguments.atoms().subspan(1);
    in(Arguments(box().name(), "plain", static_cast<int>(atoms.size()), atoms.data()));
  }
  void pose(const Arguments& arguments) {
    if (!learns_walks()) arguments.fail("expected 'in': this box was made with -in");
    if (!recorder_->recording()) return;
    take_frame(arguments, pose_);
  }

  // What comes beside frames from [gait.osc] and [gait.bvh]: where the body is, which inputs are
  // missing. A take has neither.
  void pass_over(const Arguments&) {}

  void record(const Arguments& arguments) {
    const std::string label = arguments.only().text(0);
    if (recorder_->recording()) end_take();
    if (learns_walks()) {
      if (!body()) {
        logpost(&box(), 2, "gait.train: waiting for gait-demo");
        return;
      }
      pose_.assign(3 * body()->references.size(), 0);
    }
    recorder_->start(label, inputs_ > 0 ? inputs_ : static_cast<int>(pose_.size()), outputs_);
    saver_.after(save_every);
  }
  void stop(const Arguments& arguments) {
    if (!recorder_->recording()) arguments.fail("nothing is being recorded");
    end_take();
  }

  void add(const Arguments& arguments) {
    const std::string name = arguments.only().symbol(0);
    const auto path = find_file(patch(), name);
    if (!path) arguments.fail(no_file(name));
    if (learns_walks() && !body()) arguments.fail("waiting for gait-demo");
    background().run(
        [path = path_from_utf8(*path), base = learns_walks() ? body_model() : nullptr] {
          if (path.extension() != ".bvh" && path.extension() != ".BVH") return read_takes(path);
          if (!base) throw Error("expected a file of takes: this box was made with -in");
          return std::vector{take_of_clip(path, *base->model)};
        },
        [this](std::vector<RecordedTake> takes) {
          for (RecordedTake& take : takes) add_take(std::move(take));
        },
        [this](const std::string& reason) { failed("add: " + reason); });
  }

  // The takes of an earlier session, and the one that its end cut short.
  void restore(const Arguments& arguments) {
    arguments.expect_count(0);
    if (recorder_->left_behind().empty()) arguments.fail("no earlier session left takes");
    if (learns_walks() && !body()) arguments.fail("waiting for gait-demo");
    read_left_behind([this](std::vector<RecordedTake> takes) {
      for (RecordedTake& take : takes) add_take(std::move(take));
    });
  }

  void list(const Arguments&) {
    for (std::size_t i = 0; i < recorder_->takes().size(); ++i) tell_take(static_cast<int>(i));
  }
  void remove(const Arguments& arguments) {
    arguments.expect_count(1);
    const int takes = static_cast<int>(recorder_->takes().size());
    if (takes == 0) arguments.fail("there are no takes");
    recorder_->remove(arguments.integer(0, 0, takes - 1));
  }
  void undo(const Arguments& arguments) {
    if (!recorder_->undo()) arguments.fail("there is nothing to undo");
  }

  void train(const Arguments& arguments) {
    if (learning_) arguments.fail("it is learning already ('cancel' stops it)");
    if (recorder_->recording()) end_take();
    if (recorder_->takes().empty()) arguments.fail("there are no takes to learn from");
    learning_ = std::make_shared<LearningProgress>();
    ticker_.after(look_every);
    background().run(
        [progress = learning_, task = LearningTask{recorder_->takes(), model_name(),
                                                   learns_walks() ? body_model() : nullptr}] {
          return learn(task, *progress);
        },
        [this](const LearningResult& result) {
          end_learning();
          publish(result);
        },
        [this](const std::string& reason) {
          end_learning();
          failed(reason);
        },
        Worker::patient());
  }
  void cancel(const Arguments& arguments) {
    if (!learning_) arguments.fail("nothing is being learnt");
    learning_->cancel.request();
  }
  void write(const Arguments& arguments) {
    arguments.expect_count(1);
    if (!trained_) arguments.fail("expected after 'train'");
    write_file(arguments.symbol(0), trained_->model);
  }

  void reset(const Arguments&) {
    if (recorder_->recording()) end_take();
  }
  void dump(const Arguments& arguments) { list(arguments); }
  void print(const Arguments&) {
    post("gait.train: %s: %d takes%s%s", model_name().c_str(),
         static_cast<int>(recorder_->takes().size()), recorder_->recording() ? ", recording" : "",
         learning_ ? ", learning" : "");
  }

  void cold(const Arguments& arguments) {
    if (arguments.selector() != "out" && arguments.selector() != "list")
      arguments.fail("no such message at the right inlet");
    if (!arguments.read(out_))
      slow_error().say([&] {
        return "out: expected " + std::to_string(outputs_) + " numbers, got " +
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
    ModelUser::say_ready();
    if (!tell_done_) return;
    tell_done_ = false;
    done_.add(judged_.accuracy).add(judged_.error).send("done");
  }

  // The model whose body poses are of: this name's model when it has a body, else the built-in one.
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
        return std::string(arguments.selector()) + ": expected " + std::to_string(values.size()) +
               " numbers, got " + std::to_string(arguments.size());
      });
      return;
    }
    if (!recorder_->recording()) return;
    for (const float value : values)
      if (!std::isfinite(value)) return perf().drop();
    const Perf::Frame frame(perf());
    if (!recorder_->add(clock_gettimesince(0) / 1000, values, out_)) {
      slow_error().say([] { return "the take is full (ten minutes) and has ended"; });
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
  void read_left_behind(std::function<void(std::vector<RecordedTake>)> done) {
    background().run([path = path_from_utf8(recorder_->left_behind())] { return read_takes(path); },
                     std::move(done),
                     [this](const std::string& reason) { failed("restore: " + reason); });
  }
  // `unfinished LABEL S` for a take that was being recorded when Pd ended.
  void offer() {
    read_left_behind([this](const std::vector<RecordedTake>& takes) {
      for (const RecordedTake& take : takes)
        if (!take.finished) info_.add_text(take.label).add(take.duration()).send("unfinished");
    });
  }
  // Twice a second, while a take is recorded.
  void save() {
    if (!recorder_->recording()) return;
    recorder_->save();
    saver_.after(save_every);
  }
  void look() {
    if (!learning_) return;
    info_.add(learning_->share.load()).send("progress");
    ticker_.after(look_every);
  }
  void end_learning() {
    learning_.reset();
    ticker_.cancel();
  }
  // All boxes of this name play the new model from now on.
  void publish(const LearningResult& result) {
    info_.add(1).send("progress");
    trained_ = result.model;
    judged_ = result.judged;
    post("gait.train: %s: %s", model_name().c_str(),
         verdict(judged_, learns_walks(), outputs_ > 0).c_str());
    tell_done_ = true;
    load([model = trained_] { return model; });
  }

  bool learns_walks() const { return inputs_ == 0; }

  ColdInlet cold_;
  Outlet done_, info_;
  int inputs_ = 0, outputs_ = 0;
  bool tell_done_ = false;  // once the model is `ready`
  std::unique_ptr<TakeRecorder> recorder_;
  std::vector<float> given_, pose_, out_;
  std::shared_ptr<LearningProgress> learning_;  // null: it does not learn now
  SharedModel trained_;
  TakesJudged judged_;
  Ticker ticker_{[this] { look(); }};
  Ticker saver_{[this] { save(); }}, offer_{[this] { offer(); }};
};

}  // namespace

void setup_train() {
  Class<Train>("gait.train")
      .message<&Train::in>("in")
      .list<&Train::in>()
      .messages<&Train::pass_over, &Train::pass_over, &Train::restore>({"root", "mask", "restore"})
      .messages<&Train::plain>({"plain"})
      .messages<&Train::pose, &Train::record, &Train::stop, &Train::add, &Train::remove,
                &Train::undo, &Train::train, &Train::cancel, &Train::write>(
          {"pose", "record", "stop", "add", "remove", "undo", "train", "cancel", "write"})
      .common()
      .refuse_others();
}

}  // namespace gait::pd
