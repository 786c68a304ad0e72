// How many contacts carry a grain.
#pragma once

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class ContactNumber final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"contact_number", "contacts per grain"}},
                 "1",
                 "force-carrying contacts a grain, walls included"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const Moment&) override { carrying_ = 0; }
    void contact(const Moment&, const ContactView& c) override {
        if (c.normal_force > 0) carrying_ += c.second >= 0 ? 2 : 1;
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.push_back(carrying_ / static_cast<double>(m.grains.size()));
    }

  private:
    double carrying_ = 0;  // a pair counted for both grains
};

}  // namespace grainreel::observers
