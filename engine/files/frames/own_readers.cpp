#include "engine/files/frames/own_readers.hpp"

#include <mutex>
#include <utility>

namespace grainreel {
namespace {

struct GivenReaders {
    std::mutex guard;
    std::vector<std::shared_ptr<const OwnReader>> all;
};

GivenReaders& given_readers() {
    static GivenReaders readers;
    return readers;
}

}  // namespace

void add_own_reader(std::shared_ptr<const OwnReader> reader) {
    GivenReaders& given = given_readers();
    const std::string name = reader->name();
    const std::scoped_lock lock(given.guard);
    std::erase_if(given.all, [&](const auto& one) { return one->name() == name; });
    given.all.insert(given.all.begin(), std::move(reader));
}

std::vector<std::shared_ptr<const OwnReader>> own_readers() {
    GivenReaders& given = given_readers();
    const std::scoped_lock lock(given.guard);
    return given.all;
}

}  // namespace grainreel
