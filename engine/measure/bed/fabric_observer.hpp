// How the contacts between grains are oriented.
#pragma once

#include "engine/measure/bed/fabric.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class ContactFabric final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"fabric_anisotropy", "fabric anisotropy"}},
             "1",
             "largest less smallest eigenvalue of the fabric tensor of the force-carrying contacts between "
             "grains: 0 without a preferred direction, 1 all parallel"},
            {{{"fabric_vertical", "vertical fabric"}},
             "1",
             "zz component of that tensor: 1/3 without a preferred direction, more where contacts are "
             "upright"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const Moment&) override { fabric_ = {}; }
    void contact(const Moment&, const ContactView& c) override {
        if (c.normal_force > 0 && c.second >= 0) fabric_.add(c.normal);
    }
    void look(const Moment&, std::vector<double>& row) override {
        row.insert(row.end(), {fabric_.anisotropy(), fabric_.vertical()});
    }

  private:
    Fabric fabric_;
};

}  // namespace grainreel::observers
