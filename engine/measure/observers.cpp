#include "engine/measure/observers.hpp"

#include <algorithm>

#include "engine/measure/observer_list.hpp"

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

Observers::Observers(const std::vector<ObserverEntry>& table, const std::vector<std::string>& species,
                     const std::function<bool(const std::string&)>& wanted) {
    std::vector<std::string> names;
    for (const ObserverEntry& entry : table) {
        std::vector<std::string> own;
        for (const ColumnGroup& group : entry.columns(species))
            for (const MeasureColumn& column : group.columns) own.push_back(column.name);
        if (std::none_of(own.begin(), own.end(), wanted)) continue;
        names.insert(names.end(), own.begin(), own.end());
        observers_.push_back(entry.make());
        if (observers_.back()->needs_contacts()) of_contacts_.push_back(observers_.back().get());
    }
    names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
}

Measures Observers::look(const Moment& moment, const ShowContacts& show_contacts) {
    for (const auto& observer : observers_) observer->begin(moment);
    if (!of_contacts_.empty())
        show_contacts([&](const ContactView& contact) {
            for (Observer* const observer : of_contacts_) observer->contact(moment, contact);
        });
    std::vector<double> row;
    row.reserve(names_->size());
    for (const auto& observer : observers_) observer->look(moment, row);
    return {names_, std::move(row)};
}

}  // namespace grainreel
