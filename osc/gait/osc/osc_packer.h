// OSC packer: what the packers of OSC forms share: messages laid out once, and numbers written for
// each frame in the order of the messages.
#pragma once

#include <string>
#include <vector>

#include "gait/osc/form_packer.h"
#include "gait/osc/packet_template.h"

namespace gait::osc {

class OscPacker : public FormPacker {
 public:
  std::span<const Datagram> packets() const noexcept final { return datagrams_; }

 protected:
  // While it is made: adds a message, and then ends the layout.
  void add_message(const std::string& path, const std::string& types,
                   const std::vector<std::string>& strings = {}) {
    packets_.add(path, types, strings);
  }
  void laid_out();

  // For each frame: begin(), then all numbers, then end().
  void begin() noexcept { next_ = 0; }
  void add(double number) noexcept {
    if (next_ < numbers_.size()) numbers_[next_++] = static_cast<float>(number);
  }
  void add(const Eigen::Vector3d& p) noexcept { add(p.x()), add(p.y()), add(p.z()); }
  void add(const Eigen::Quaterniond& q) noexcept {  // x y z w
    add(q.x()), add(q.y()), add(q.z()), add(q.w());
  }
  void end() noexcept;

 private:
  PacketSequence packets_;
  std::vector<float> numbers_;
  std::size_t next_ = 0;
  std::vector<Datagram> datagrams_;
};

}  // namespace gait::osc
