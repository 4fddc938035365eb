#include "gait/judge/played_sequence.h"

#include "gait/motion/rotation.h"

namespace gait {

PlayedSequence play_sequence(const PlayModel& played_model, const PlaySettings& settings,
                             const Sequence& sequence) {
  const Model& model = *played_model.model;
  const int frames = static_cast<int>(sequence.inputs.cols());
  PlayedSequence played;
  played.outputs.resize(model.output.values, frames);
  played.style_posteriors.resize(static_cast<Eigen::Index>(model.styles.size()), frames);
  played.true_label.assign(frames, -1);
  for (const Segment& segment : sequence.segments)
    for (int frame = segment.begin; frame < segment.end; ++frame)
      played.true_label[frame] = segment.label;
  if (!sequence.segments.empty()) {
    played.begin = sequence.segments.front().begin;
    played.end = sequence.segments.back().end;
  }

  PlaySettings streams = settings;
  streams.on_stage = false;
  StreamReconstructor reconstructor(played_model, streams);
  const Eigen::MatrixXf inputs = sequence.inputs.cast<float>();
  const auto collect = [&] {
    const ReconstructedFrame& made = reconstructor.frame();
    const auto frame = static_cast<Eigen::Index>(played.decisions.size());
    played.outputs.col(frame) =
        Eigen::Map<const Eigen::VectorXf>(made.outputs.data(), played.outputs.rows())
            .cast<double>();
    played.style_posteriors.col(frame) =
        Eigen::Map<const Eigen::VectorXf>(made.styles.data(), played.style_posteriors.rows());
    played.decisions.push_back(made.decision);
  };
  for (int frame = 0; frame < frames; ++frame)
    if (reconstructor.advance({inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())}))
      collect();
  while (reconstructor.flush()) collect();
  return played;
}

Eigen::VectorXd stream_errors(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& a,
                              const Eigen::Ref<const Eigen::VectorXd>& b) {
  Eigen::VectorXd errors(static_cast<Eigen::Index>(model.outputs.size()));
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < model.outputs.size(); ++i) {
    const Stream& stream = model.outputs[i];
    auto& error = errors[static_cast<Eigen::Index>(i)];
    if (stream.kind == StreamKind::rotation)
      error = angle_between(exponential_map<double>(a.segment<3>(at)),
                            exponential_map<double>(b.segment<3>(at)));
    else
      error = (a.segment(at, stream.size) - b.segment(at, stream.size)).cwiseAbs().mean();
    at += stream.size;
  }
  return errors;
}

}  // namespace gait
