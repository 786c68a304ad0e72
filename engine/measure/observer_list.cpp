#include "engine/measure/observer_list.hpp"

#include "engine/measure/observers.hpp"

namespace grainreel {
namespace {

template <class... Each>
std::vector<ObserverEntry> entries_of(ObserverList<Each...>) {
    return {entry_of<Each>()...};
}

}  // namespace

const std::vector<ObserverEntry>& all_observers() {
    static const std::vector<ObserverEntry> all = entries_of(RowObservers());
    return all;
}

}  // namespace grainreel
