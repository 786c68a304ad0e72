// The observers of one run. They are made from the list, give their rows of values, and are saved with the
// data that they gather.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel {

// Shows all contacts of a moment to `see`.
using ShowContacts = std::function<void(const std::function<void(const ContactView&)>& see)>;

// The observers of observer_list.hpp, in the order of their columns.
const std::vector<ObserverEntry>& all_observers();

class Observers {
  public:
    // Makes the observers of `table` that are always made, and the instruments that the scene asks for.
    Observers(const std::vector<ObserverEntry>& table, const Scene& scene, const Plan& plan);

    const std::vector<std::string>& names() const { return *names_; }
    // Gives a value for each name. Calls show_contacts once if an observer needs contacts, else not at all.
    Measures look(const ObservedState& moment, const ShowContacts& show_contacts);
    // Gives the value of one column, which must exist. Only the observer of this column is called.
    double look(const ObservedState& moment, const ShowContacts& show_contacts, const std::string& column);

    // The sets of fields, observer by observer, and their values at a moment in the same order.
    std::vector<const FieldSet*> fields() const;
    std::vector<FieldValues> look_at_fields(const ObservedState& moment, const ShowContacts& show_contacts);

    // Whether an observer needs ObservedState::wall_sums.
    bool need_wall_sums() const;
    // Starts the observers when the drive starts. After load() it starts only those without loaded data.
    void start(const ObservedState& moment, const ShowContacts& show_contacts);
    // The first step after `step` at which an observer gathers, or Observer::kNever.
    std::int64_t gathers_after(std::int64_t step) const;
    // Calls the observers that gather at this step.
    void gather(const ObservedState& moment, const ShowContacts& show_contacts);

    // Saves and loads the gathered data, for the checkpoint. Reading fails for anything that save() cannot
    // have written. Data of observers that are not made are skipped.
    void save(std::ostream& out) const;
    void load(const ObservedState& moment, Bytes& in);

  private:
    struct Entry {
        std::string name;  // name in the checkpoint
        std::unique_ptr<Observer> observer;
        std::vector<std::string> columns;
        bool started = false;
    };
    template <class Wanted, class Call>
    void visit(const ObservedState& moment, const ShowContacts& show_contacts, const Wanted& wanted,
               const Call& call);

    Measures::Names names_;
    std::vector<Entry> entries_;
};

}  // namespace grainreel
