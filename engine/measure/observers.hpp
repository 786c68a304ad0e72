// The observers that somebody wants, and their row of numbers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel {

// Shows all contacts of a moment to `see`.
using ShowContacts = std::function<void(const std::function<void(const ContactView&)>& see)>;

// Those of measures.csv (observer_list.hpp), in the order of its columns.
const std::vector<ObserverEntry>& all_observers();

class Observers {
  public:
    // Makes those of `table` that give one of the columns `wanted`, and no others. species: names.
    Observers(const std::vector<ObserverEntry>& table, const std::vector<std::string>& species,
              const std::function<bool(const std::string&)>& wanted);

    // All columns of the observers that were made. Calls show_contacts once where an observer needs contacts,
    // else not at all.
    Measures look(const Moment& moment, const ShowContacts& show_contacts);

  private:
    Measures::Names names_;
    std::vector<std::unique_ptr<Observer>> observers_;
    std::vector<Observer*> of_contacts_;
};

}  // namespace grainreel
