// Where the drive has moved to.
#pragma once

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class FloorPosition final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"floor_position_m", "floor position", Dimension::length}},
                 "m",
                 "displacement of what the drive moves, along `drive.direction`"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.push_back(m.pose.offset.dot(m.scene.drive.direction));
    }
};

}  // namespace grainreel::observers
