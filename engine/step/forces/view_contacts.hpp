// Shows contacts to observers.
#pragma once

#include <cstddef>
#include <functional>

#include "engine/step/contact_view.hpp"
#include "engine/step/forces/law_input.hpp"
#include "engine/step/lists/thread_contacts.hpp"

namespace grainreel {

// Shows every touching contact of a group under an own grain of the thread. Late contacts began since the
// last refresh; the others come by rising first and second body. Which contacts are late does not depend on
// the threads.
void view_contacts(const ForceInput& in, std::size_t group, const ThreadContacts& contacts,
                   const std::function<void(const ContactView&)>& in_order,
                   const std::function<void(const ContactView&)>& late);

}  // namespace grainreel
