// Model files, NAME.gait: one CBOR document (RFC 8949) that holds everything of a Model, to the
// bit.
//
// docs/model-file.md says what is in it, field by field. Reading trusts nothing: what comes out can
// be played.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gait/alignment.h"
#include "gait/model/model.h"

namespace gait {

// The newest form of the file that this library reads, and the one it writes.
inline constexpr int model_file_version = 2;

// Frames per second that a model may have.
inline constexpr double slowest_frame_rate = 1, fastest_frame_rate = 1000;

// Reads a model. Throws Error with file and field where the file cannot be read, is no model file,
// is cut short, is newer than this library, or holds what check_model refuses. Keys it does not
// know are passed over.
Model read_model(const std::filesystem::path& path);
// The same from memory; `name` stands for the file in errors.
Model parse_model(std::span<const std::uint8_t> bytes, const std::string& name);

// Writes a model, to a temporary file beside its place first, then renamed: an old file there stays
// whole until the new one is. Throws Error where check_model does, or when it cannot be written.
void write_model(const Model& model, const std::filesystem::path& path);
// The same to memory. Of covariances the lower triangle is kept.
std::vector<std::uint8_t> model_bytes(const Model& model);

// Throws Error naming the field, e.g. `labels[1].states[3].covariance: expected a positive definite
// matrix`, when the model cannot be played: sizes that do not belong together, indices out of
// range, numbers that are not finite or absurd, covariances that are not symmetric and positive
// definite.
void check_model(const Model& model);

}  // namespace gait
