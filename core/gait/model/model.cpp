#include "gait/model/model.h"

namespace gait {

int values_of(const std::vector<Stream>& streams) {
  int values = 0;
  for (const Stream& stream : streams) values += stream.size;
  return values;
}

}  // namespace gait
