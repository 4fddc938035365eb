// What a recogniser and a mapping tell a synthesiser about a walk, frame by frame, made from the
// same parts as a reconstructor's, without it.
#pragma once

#include <vector>

#include "gait/motion/observation.h"
#include "gait/play/map/covariance_map.h"
#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/emissions.h"
#include "play/played_stream.h"

namespace gait::testing {

struct Told {
  std::vector<float> means, variances;  // over all output values: statics, differences
  float phase = 0, cadence = 0;
  std::vector<float> styles;
};

inline std::vector<Told> told_gaussians(const std::shared_ptr<const Model>& model,
                                        const Eigen::MatrixXf& inputs) {
  const auto tables = make_state_tables(*model);
  InputObserver<float> observer(model->input, model->input_scaling);
  Emissions emissions(tables, model->input);
  Decoder decoder(tables, DecoderKind::forward, 0, static_cast<float>(model->play.temper),
                  model->frame_rate);
  CovarianceMap map(*model, tables);
  RecogniserSettings settings;
  settings.decoder = DecoderKind::forward;
  Recogniser recogniser(model, settings);
  std::vector<Told> told;
  const std::size_t values = static_cast<std::size_t>(model->output.values);
  const std::size_t modelled = model->output.modelled.size();
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    observer.advance(frame_of(inputs, frame));
    decoder.advance(emissions.of(observer.scaled(), observer.known()));
    const OutputGaussian& gaussian =
        map.map(decoder.weighted(), observer.unclipped(), observer.known());
    Told of;
    of.means.assign(3 * values, 0.0f);
    of.variances.assign(3 * values, 0.0f);
    for (std::size_t i = 0; i < values; ++i)
      of.means[i] = static_cast<float>(model->output_mean[static_cast<Eigen::Index>(i)]);
    for (std::size_t part = 0; part < 3; ++part)
      for (std::size_t i = 0; i < modelled; ++i) {
        const auto from = static_cast<Eigen::Index>(part * modelled + i);
        const std::size_t to = part * values + static_cast<std::size_t>(model->output.modelled[i]);
        of.means[to] = gaussian.mean[from];
        of.variances[to] = gaussian.variance[from];
      }
    recogniser.advance(frame_of(inputs, frame));
    of.phase = recogniser.decision().phase;
    of.cadence = recogniser.decision().cadence;
    of.styles.assign(recogniser.styles().begin(), recogniser.styles().end());
    told.push_back(std::move(of));
  }
  return told;
}

}  // namespace gait::testing
