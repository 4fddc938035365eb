// Which stream of a model a message speaks of: by number, from 0 in the model's order, or by name
// (of a joint).
#pragma once

#include <string>
#include <vector>

#include "gait/model/model.h"
#include "gait/names.h"
#include "pd/arguments.h"

namespace gait::pd {

// `what`: "input" or "output", for the error. Where there is such a stream, nothing allocates.
inline int stream_argument(const Arguments& arguments, int i, const std::vector<Stream>& streams,
                           const char* what) {
  if (arguments.is_number(i)) return arguments.integer(i, 0, static_cast<int>(streams.size()) - 1);
  if (!arguments.is_symbol(i)) arguments.fail_at(i, std::string("an ") + what);
  const char* const name = arguments.atoms()[static_cast<std::size_t>(i)].a_w.w_symbol->s_name;
  for (std::size_t stream = 0; stream < streams.size(); ++stream)
    if (streams[stream].name == name) return static_cast<int>(stream);
  arguments.fail("no " + std::string(what) + " '" + name + "'; there are " +
                 joined_names(streams, &Stream::name));
}

}  // namespace gait::pd
