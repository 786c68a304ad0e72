// Centre of mass of all grains.
#pragma once

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class CentreOfMass final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"centre_x_m", "centre of mass, x", Dimension::length},
                  {"centre_y_m", "centre of mass, y", Dimension::length},
                  {"centre_z_m", "centre of mass, z", Dimension::length}},
                 "m",
                 "centre of mass of all grains"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        Vec3 centre = Vec3::Zero();
        double mass = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            centre += m.grains.mass(i) * m.grains.place[i].position;
            mass += m.grains.mass(i);
        }
        centre /= mass;
        row.insert(row.end(), {centre.x(), centre.y(), centre.z()});
    }
};

}  // namespace grainreel::observers
