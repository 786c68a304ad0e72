#include "engine/measure/observers.hpp"

#include <algorithm>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/measure/observer_list.hpp"

namespace grainreel {

namespace {

bool gathers(const Observer& observer) {
    return observer.gathers_after(-1) != Observer::kNever;
}

bool is_wanted(const ObserverEntry& entry, const Scene& scene) {
    if (entry.wanted != nullptr) return entry.wanted(scene);
    const std::vector<std::string> wanted = scene.instruments();
    return entry.instrument == nullptr || contains(wanted, entry.instrument);
}

}  // namespace

Observers::Observers(const std::vector<ObserverEntry>& table, const Scene& scene, const Plan& plan) {
    std::vector<std::string> names;
    for (const ObserverEntry& known : table) {
        if (!is_wanted(known, scene)) continue;
        Entry entry;
        for (const ColumnGroup& group : known.columns(scene))
            for (const MeasureColumn& column : group.columns) entry.columns.push_back(column.name);
        names.insert(names.end(), entry.columns.begin(), entry.columns.end());
        entry.name = known.instrument != nullptr ? known.instrument
                     : entry.columns.empty()     ? ""
                                                 : entry.columns.front();
        entry.observer = known.make(scene, plan);
        if (const FieldSet* const set = entry.observer->fields(); set != nullptr && entry.name.empty())
            entry.name = set->fields.front().name;
        entries_.push_back(std::move(entry));
    }
    names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
}

// Calls begin(), contact() for all contacts, and then `call` for the entries that are wanted.
template <class Wanted, class Call>
void Observers::visit(const ObservedState& moment, const ShowContacts& show_contacts, const Wanted& wanted,
                      const Call& call) {
    std::vector<Entry*> chosen;
    std::vector<Observer*> of_contacts;
    for (Entry& entry : entries_) {
        if (!wanted(entry)) continue;
        chosen.push_back(&entry);
        if (entry.observer->needs_contacts()) of_contacts.push_back(entry.observer.get());
        entry.observer->begin(moment);
    }
    if (!of_contacts.empty())
        show_contacts([&](const ContactView& contact) {
            for (Observer* const observer : of_contacts) observer->contact(moment, contact);
        });
    for (Entry* const entry : chosen) call(*entry);
}

Measures Observers::look(const ObservedState& moment, const ShowContacts& show_contacts) {
    std::vector<double> row;
    row.reserve(names_->size());
    visit(
        moment, show_contacts, [](const Entry& entry) { return !entry.columns.empty(); },
        [&](Entry& entry) { entry.observer->look(moment, row); });
    return {names_, std::move(row)};
}

double Observers::look(const ObservedState& moment, const ShowContacts& show_contacts,
                       const std::string& column) {
    std::vector<double> row;
    std::size_t index = 0;
    const auto gives_it = [&](const Entry& entry) {
        const std::optional<std::size_t> place = place_in(entry.columns, column);
        if (place) index = *place;
        return place.has_value();
    };
    visit(moment, show_contacts, gives_it, [&](Entry& entry) { entry.observer->look(moment, row); });
    GRAINREEL_CHECK(index < row.size());
    return row[index];
}

std::vector<const FieldSet*> Observers::fields() const {
    std::vector<const FieldSet*> sets;
    for (const Entry& entry : entries_)
        if (const FieldSet* const set = entry.observer->fields()) sets.push_back(set);
    return sets;
}

std::vector<FieldValues> Observers::look_at_fields(const ObservedState& moment,
                                                   const ShowContacts& show_contacts) {
    std::vector<FieldValues> values;
    visit(
        moment, show_contacts, [](const Entry& entry) { return entry.observer->fields() != nullptr; },
        [&](Entry& entry) { values.push_back(entry.observer->look_at_fields(moment)); });
    return values;
}

bool Observers::need_wall_sums() const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return entry.observer->needs_wall_sums(); });
}

void Observers::start(const ObservedState& moment, const ShowContacts& show_contacts) {
    visit(
        moment, show_contacts, [](const Entry& entry) { return !entry.started && gathers(*entry.observer); },
        [&](Entry& entry) {
            entry.observer->start(moment);
            entry.started = true;
        });
}

std::int64_t Observers::gathers_after(std::int64_t step) const {
    std::int64_t next = Observer::kNever;
    for (const Entry& entry : entries_) next = std::min(next, entry.observer->gathers_after(step));
    return next;
}

void Observers::gather(const ObservedState& moment, const ShowContacts& show_contacts) {
    visit(
        moment, show_contacts,
        [&](const Entry& entry) { return entry.observer->gathers_after(moment.step - 1) == moment.step; },
        [&](Entry& entry) { entry.observer->gather(moment); });
}

void Observers::save(std::ostream& out) const {
    for (const Entry& entry : entries_) {
        if (!gathers(*entry.observer)) continue;
        std::ostringstream own;
        entry.observer->save(own);
        const std::string bytes = own.str();
        write_vector(out, std::vector<char>(entry.name.begin(), entry.name.end()));
        write_vector(out, std::vector<char>(bytes.begin(), bytes.end()));
    }
}

void Observers::load(const ObservedState& moment, Bytes& in) {
    while (in.left() > 0 && !in.failed()) {
        std::vector<char> name, bytes;
        read_vector(in, name);
        read_vector(in, bytes);
        const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
            return std::equal(name.begin(), name.end(), entry.name.begin(), entry.name.end());
        });
        if (in.failed() || found == entries_.end() || !gathers(*found->observer)) continue;
        Bytes own(std::string_view(bytes.data(), bytes.size()));
        found->observer->load(moment, own);
        if (own.failed() || own.left() > 0 || found->started) return in.fail();
        found->started = true;
    }
}

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
