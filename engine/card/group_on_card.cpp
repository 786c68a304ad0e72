// Contacts on their way to a card and back.

#include <algorithm>
#include <cstring>
#include <tuple>

#include "engine/card/card_bed.hpp"

namespace grainreel::card {

namespace {

std::int32_t whole_blocks_of(std::int32_t count) {
    return (count + kBlock - 1) / kBlock * kBlock;
}

struct HostLists {
    std::vector<std::int32_t> start, at;
};

// Lists the places from `begin` on, whose bodies these are, by grain. Where `of_pairs`, a contact is in the
// lists of both.
HostLists lists_by_grain(const std::int32_t* first, const std::int32_t* second, std::int32_t count,
                         std::int32_t begin, bool of_pairs, std::int32_t grains) {
    HostLists lists;
    lists.start.assign(static_cast<std::size_t>(grains) + 1, 0);
    for (std::int32_t c = 0; c < count; ++c) {
        ++lists.start[first[c] + 1];
        if (of_pairs) ++lists.start[second[c] + 1];
    }
    for (std::int32_t i = 0; i < grains; ++i) lists.start[i + 1] += lists.start[i];
    lists.at.resize(lists.start[grains]);
    std::vector<std::int32_t> next(lists.start.begin(), lists.start.end() - 1);
    for (std::int32_t c = 0; c < count; ++c) {
        lists.at[next[first[c]]++] = 2 * (begin + c);
        if (of_pairs) lists.at[next[second[c]]++] = 2 * (begin + c) + 1;
    }
    return lists;
}

}  // namespace

GroupOnCard::GroupOnCard(Device& device, const ContactGroup& group)
    : parameters_(device),
      rolling_parameters_(device),
      history_(device),
      push_(device),
      row_(device),
      first_(device),
      second_(device),
      began_(device),
      late_start_(device),
      late_at_(device),
      late_count_(device),
      state_(device),
      sorted_{Array<std::int32_t>(device), Array<std::int32_t>(device)},
      candidates_{Array<std::int32_t>(device), Array<std::int32_t>(device)} {
    group_.kinds = group.parameters.kinds;
    group_.history_size = group.history_size();
    group_.law_history_size = group.law->history_size;
    group_.of_pairs = group.of_pairs;
    group_.rubs = group.law->rubs;
    group_.rolls = group.rolling != nullptr;
    group_.uses_radius = group.law->uses_radius || group.rolling;
    group_.at_mid_step = group.law->at_mid_step;
    group_.parameters = parameters_.send(group.parameters.values);
    group_.rolling_parameters = rolling_parameters_.send(group.rolling_parameters.values);
    group_.row = row_.send(group.row);
}

void GroupOnCard::bring(const ContactRules& rules, const ContactTable& table, std::int32_t grains) {
    group_.row_species = rules.species;
    group_.begin_of_candidates = whole_blocks_of(table.size());
    group_.places = whole_blocks_of(group_.begin_of_candidates + table.candidates());
    bring_places(table);
    const HostLists sorted =
        lists_by_grain(table.first(), table.second(), table.sorted(), 0, group_.of_pairs, grains);
    group_.sorted = {sorted_.start.send(sorted.start), sorted_.at.send(sorted.at)};
    const HostLists near = lists_by_grain(table.near_first(), table.near_second(), table.candidates(),
                                          group_.begin_of_candidates, group_.of_pairs, grains);
    group_.candidates = {candidates_.start.send(near.start), candidates_.at.send(near.at)};
    bring_late(table, near.start, grains);
}

// What lies in each place.
void GroupOnCard::bring_places(const ContactTable& table) {
    const std::int32_t places = group_.places, near = group_.begin_of_candidates;
    std::vector<std::int32_t> first(places, 0), second(places, 0);
    std::vector<std::uint8_t> state(places, kEmpty);
    table.each_stretch([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t c = begin; c < end; ++c) {
            first[c] = table.first()[c], second[c] = table.second()[c];
            state[c] = table.touches(c) ? kTouches : kParted;
        }
    });
    for (std::int32_t c = 0; c < table.candidates(); ++c) {
        first[near + c] = table.near_first()[c], second[near + c] = table.near_second()[c];
        const bool admitted = table.admitted(c / kChunk * kChunk) >> c % kChunk & 1;
        state[near + c] = admitted ? kEmpty : kWaits;
    }
    group_.first = first_.send(first);
    group_.second = second_.send(second);
    group_.state = state_.send(state);
    group_.began = began_.send(std::vector<std::int32_t>(places, 0));
    group_.push = push_.resize(static_cast<std::size_t>(places) * kPushNumbers);
    std::vector<double> history(static_cast<std::size_t>(places) * group_.history_size, 0.0);
    if (table.size() > 0)
        std::memcpy(history.data(), table.histories().of_block(0),
                    static_cast<std::size_t>(near) * group_.history_size * sizeof(double));
    group_.history = history_.send(history);
}

// The late contacts of each grain, with room for all its candidates.
void GroupOnCard::bring_late(const ContactTable& table, const std::vector<std::int32_t>& candidates,
                             std::int32_t grains) {
    const std::int32_t late = std::min(table.late(), table.size());
    const HostLists now = lists_by_grain(table.first() + late, table.second() + late, table.size() - late,
                                         late, group_.of_pairs, grains);
    std::vector<std::int32_t> start(static_cast<std::size_t>(grains) + 1), count(grains),
        at(now.at.size() + static_cast<std::size_t>(candidates[grains]));
    for (std::int32_t i = 0; i <= grains; ++i) start[i] = now.start[i] + candidates[i];
    for (std::int32_t i = 0; i < grains; ++i) {
        count[i] = now.start[i + 1] - now.start[i];
        std::copy_n(now.at.begin() + now.start[i], count[i], at.begin() + start[i]);
    }
    group_.late_start = late_start_.send(start);
    group_.late_at = late_at_.send(at);
    group_.late_count = late_count_.send(count);
}

void GroupOnCard::fetch(const ContactRules& rules, std::size_t number, std::int32_t evaluations,
                        ThreadContacts& contacts) const {
    ContactTable& table = contacts.tables[number];
    const std::int32_t near = group_.begin_of_candidates, before = table.size();
    std::vector<std::uint8_t> state(group_.places);
    std::vector<std::int32_t> began(group_.places);
    std::vector<double> history(static_cast<std::size_t>(group_.places) * group_.history_size);
    state_.get(state.data(), state.size());
    began_.get(began.data(), began.size());
    history_.get(history.data(), history.size());

    std::vector<std::int32_t> news;  // candidates that became contacts, in the order in which they did
    for (std::int32_t c = 0; c < table.candidates(); ++c)
        if (state[near + c] > kWaits) news.push_back(c);
    std::stable_sort(news.begin(), news.end(),
                     [&](std::int32_t a, std::int32_t b) { return began[near + a] < began[near + b]; });
    auto next = news.begin();
    for (std::int32_t e = 1; e <= evaluations; ++e) {
        table.begin_step();
        for (; next != news.end() && began[near + *next] == e; ++next)
            table.admit(*next / kChunk * kChunk, std::uint64_t{1} << *next % kChunk);
        contacts.note_loaded(rules, number, table.end_step(), table.size());
    }
    // The new contacts follow the late ones in the table, in this order.
    const std::int32_t begin_of_new = table.size() - static_cast<std::int32_t>(news.size());
    std::vector<std::int32_t> place(table.size());
    for (std::int32_t c = 0; c < table.size(); ++c)
        place[c] = c < begin_of_new ? c : near + news[c - begin_of_new];
    table.each_chunk([&](std::int32_t c, int count) {
        std::uint64_t touching = 0;
        for (int k = 0; k < count; ++k) touching |= std::uint64_t{state[place[c + k]] == kTouches} << k;
        table.note_touching(c, touching);
    });
    if (before > 0)
        std::memcpy(table.histories().of_block(0), history.data(),
                    static_cast<std::size_t>(near) * group_.history_size * sizeof(double));
    for (std::int32_t c = begin_of_new; c < table.size(); ++c)
        for (int k = 0; k < group_.history_size; ++k) {
            const std::int32_t at = place[c];
            table.histories().set(
                c, k,
                history[(static_cast<std::size_t>(at / kBlock) * group_.history_size + k) * kBlock +
                        at % kBlock]);
        }
}

}  // namespace grainreel::card
