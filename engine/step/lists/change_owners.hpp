// What happens to contacts when grains get new indices and new owners, or leave. Contacts keep their
// histories.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/step/lists/thread_contacts.hpp"

namespace grainreel {

// The thread that owns the grain.
int owner_of(const Shares& shares, std::int32_t grain);

// A new order of the grains, and new shares of the threads.
struct Renumbering {
    const std::vector<std::int32_t>& index;  // new index of each grain, by its old index
    const Shares &before, &after;
};

// Counts the contacts in which each of the thread's own grains is the first body, and adds them to `count`
// under the grain's new number, which `index` gives.
void count_contacts(const ThreadContacts& contacts, const std::vector<std::int32_t>& index,
                    std::vector<std::int32_t>& count);

// Gives the bodies of all contacts of a thread their new numbers. Contacts that another thread needs from now
// on, and did not have, go to `leaving`, by group. Their tag is the number of that thread.
void renumber(const ContactRules& rules, int thread, const Renumbering& to, ThreadContacts& contacts,
              std::vector<KeptContacts>& leaving);
// Takes the contacts that another thread has put into `leaving` for this one.
void take(int thread, const std::vector<KeptContacts>& leaving, ThreadContacts& contacts);

// Renumbers contacts after some grains have left; the others keep their order. A grain that has left has the
// new index kGone, and its contacts are dropped. ThreadContacts::own() and refresh() must follow.
constexpr std::int32_t kGone = -1;
void leave_out(const ContactRules& rules, const std::vector<std::int32_t>& index, ThreadContacts& contacts);
void leave_out(const std::vector<std::int32_t>& index, NeighbourLists& lists);

}  // namespace grainreel
