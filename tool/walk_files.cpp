#include "walk_files.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "commands.h"
#include "gait/error.h"
#include "gait/files/label_file.h"
#include "gait/motion/captured/looped_clip.h"
#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "manifest.h"
#include "name_pattern.h"
#include "option_kinds.h"

namespace gait::tool {

namespace fs = std::filesystem;

const char* const label_help =
    R"(--label reads a file's name: {style}, {subject} and {speed} (m/s) are kept, {take} is a whole
number, {*} anything or nothing, all else stands for itself. Where a name could be read in
several ways, fields are as short as possible from left to right. Without --label, files
named walk_STYLE_TAKE.bvh have their style.
A manifest is a CSV table with the columns file, style, subject, speed (any but file may be
missing); its files are found from its own folder. What it says counts before a name.
A label file beside a clip (same name, .txt or .lab) says when the feet touch.)";

namespace {

constexpr const char* usual_pattern = "walk_{style}_{take}.bvh";

// The same file by whatever path it is named.
fs::path identity(const fs::path& path) {
  std::error_code failure;
  const fs::path real = fs::weakly_canonical(path, failure);
  return failure ? path.lexically_normal() : real;
}

// What is said of files before they are read.
class Said {
 public:
  Said(const WalkReading& reading, const std::string& command)
      : pattern_given_(!reading.pattern.empty()),
        pattern_(pattern_given_ ? reading.pattern : usual_pattern) {
    if (reading.manifest.empty()) return;
    manifest_name_ = reading.manifest;
    manifest_ = read_manifest(path_from_utf8(reading.manifest));
    for (const std::string& warning : manifest_.warnings)
      std::fprintf(stderr, "gait %s: warning: %s\n", command.c_str(), warning.c_str());
    for (const ManifestEntry& entry : manifest_.entries) {
      if (!fs::exists(entry.file))
        throw Error(manifest_name_ + ":" + std::to_string(entry.line) + ": there is no file " +
                    utf8_of(entry.file));
      by_file_[identity(entry.file)] = &entry;
    }
  }

  const Manifest& manifest() const { return manifest_; }

  NameFields of(const fs::path& path, std::string& remark) const {
    const auto add = [&](const std::string& text) { append_name(remark, text); };
    const auto named = pattern_.read(utf8_of(path.filename()));
    if (!named && pattern_given_) add("its name does not fit --label");
    NameFields fields = named.value_or(NameFields{});
    if (manifest_name_.empty()) return fields;
    const auto entry = by_file_.find(identity(path));
    if (entry == by_file_.end()) {
      add("not in the manifest");
      return fields;
    }
    const NameFields& written = entry->second->fields;
    if (!written.style.empty()) fields.style = written.style;
    if (!written.subject.empty()) fields.subject = written.subject;
    if (written.speed) fields.speed = written.speed;
    return fields;
  }

 private:
  bool pattern_given_;
  NamePattern pattern_;
  std::string manifest_name_;
  Manifest manifest_;
  std::map<fs::path, const ManifestEntry*> by_file_;
};

std::vector<fs::path> files_meant(const WalkReading& reading, const Manifest& manifest) {
  std::vector<fs::path> named = clips_below(reading.paths);
  if (reading.paths.empty())
    for (const ManifestEntry& entry : manifest.entries) named.push_back(entry.file);
  std::set<fs::path> seen;
  std::erase_if(named, [&](const fs::path& path) { return !seen.insert(identity(path)).second; });
  return named;
}

// Contacts from a label file beside the clip, if there is one.
std::vector<Contact> contacts_beside(const fs::path& path, const Clip& clip, int first_row,
                                     std::string& remark) {
  for (const char* ending : {".txt", ".lab"}) {
    const fs::path labels = fs::path(path).replace_extension(ending);
    if (!fs::is_regular_file(labels)) continue;
    std::vector<Contact> contacts;
    try {
      contacts = contacts_from_labels(
          labels_from(read_labels(labels).segments, first_row / clip.frame_rate), clip.frame_rate);
    } catch (const Error& error) {
      const std::string text = error.what();
      throw Error((text.starts_with(utf8_of(labels)) ? "" : utf8_of(labels) + ": ") + text +
                  " (labels of " + utf8_of(path.filename()) + "; --no-labels leaves them out)");
    }
    const std::string name = utf8_of(labels.filename());
    if (contacts.empty()) {
      append_name(remark, name + " has no steps, contacts are found");
      return contacts;
    }
    // The last step may end with the clip.
    if (contacts.back().frame == clip.frames()) --contacts.back().frame;
    if (contacts.back().frame >= clip.frames()) {
      char text[128];
      std::snprintf(text, sizeof text,
                    ": expected steps within the clip's %.3f s, found one at %.3f s",
                    clip.frames() / clip.frame_rate, contacts.back().frame / clip.frame_rate);
      throw Error(utf8_of(labels) + text + " (labels of " + utf8_of(path.filename()) +
                  "; --no-labels leaves them out)");
    }
    append_name(remark, "contacts from " + name);
    return contacts;
  }
  return {};
}

// A loop as several passes in a row.
void go_round(Walk& walk, std::string& remark) {
  const int period = walk.clip.frames() - 1;
  std::vector<Contact> contacts;
  for (int pass = 0; pass < loop_passes; ++pass)
    for (const Contact& contact : walk.contacts)
      if (contacts.empty() || contacts.back().foot != contact.foot)
        contacts.push_back({contact.frame + pass * period, contact.foot});
  walk.contacts = std::move(contacts);
  walk.clip = unrolled(walk.clip, loop_passes);
  append_name(remark, "a loop, gone round " + std::to_string(loop_passes) + " times");
}

}  // namespace

void add_walk_reading(CLI::App& app, WalkReading& reading) {
  add_argument(app, "CLIPS", reading.paths, "BVH files, or folders with some")->required(false);
  add_value(app, "--label", "PATTERN", reading.pattern,
            "What file names say, e.g. 'walk_{style}_{take}.bvh' (see below)");
  add_value(app, "--manifest", "FILE", reading.manifest,
            "CSV table of style, subject and speed; without CLIPS also of which clips");
  app.add_flag("--no-labels", reading.no_labels,
               "Find contacts in the motion even where a label file lies beside a clip");
  app.add_flag("--calibrate", reading.calibrate,
               "Accept bones that rest in other directions than the model's, or the first clip's: "
               "turn their joints' frames to match");
  add_clip_reading(app, reading.clip);
}

WalksRead read_walks(const WalkReading& reading, const std::string& command,
                     const std::function<void(double, const std::string&)>& progress) {
  if (reading.paths.empty() && reading.manifest.empty())
    throw UsageError("no clips given: expected BVH files or folders, or a --manifest");
  WalksRead read;
  if (!reading.clip.roles.empty()) read.roles = read_role_table(path_from_utf8(reading.clip.roles));
  const Said said(reading, command);
  const std::vector<fs::path> files = files_meant(reading, said.manifest());
  if (files.empty()) throw Error(reading.manifest + ": names no clips");
  std::vector<std::string> without_joint;  // names of --roles, until a clip has them
  for (const auto& entry : read.roles) without_joint.push_back(entry.first);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path& path = files[i];
    progress(static_cast<double>(i) / static_cast<double>(files.size()), utf8_of(path.filename()));
    WalkFile file{path, ""};
    Walk walk;
    ReadClip in_file = read_clip(path, reading.clip);
    print_doubts(command, in_file, true);
    walk.clip = std::move(in_file.clip);
    std::erase_if(without_joint, [&](const std::string& name) {
      return std::count(in_file.roles_without_joint.begin(), in_file.roles_without_joint.end(),
                        name) == 0;
    });
    const NameFields fields = said.of(path, file.remark);
    walk.style = fields.style;
    walk.subject = fields.subject;
    walk.speed = fields.speed;
    if (!reading.no_labels)
      walk.contacts = contacts_beside(path, walk.clip, in_file.first_row, file.remark);
    if (in_file.loop) go_round(walk, file.remark);
    read.walks.push_back(std::move(walk));
    read.files.push_back(std::move(file));
  }
  warn_of_roles(command, reading.clip, without_joint);
  return read;
}

}  // namespace gait::tool
