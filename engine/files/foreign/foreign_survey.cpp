// What a file of another program holds, as far as its first looks tell: its grains, contacts, species and
// walls.
#include "engine/files/foreign/foreign_archive.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/foreign/names.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

bool is_numbered(const std::string& type) {
    return type.find_first_not_of("0123456789.+-e") == std::string::npos;
}

// The line that tells of a word among types that are numbers, and is likely to be a slip; empty if there is
// none. Who names its species with --species knows of it.
std::string line_of_stray_type(const TypeList& types, const ReadingOptions& options,
                               const std::string& file) {
    const std::vector<std::string>& words = types.words();
    if (std::none_of(words.begin(), words.end(), is_numbered)) return "";
    for (const std::string& word : words)
        if (!is_numbered(word) && !options.species.contains(word))
            return fmt::format(
                "{}: types are numbers, but one is \"{}\", which becomes a species of its own; mend the "
                "file if it is a slip, or name that species by --species",
                file, excerpt(word));
    return "";
}

// The line that tells of types that --species names and no grain has. They may come later, where files grow;
// but a word does not come among types that are numbers. Throws UserError for such a word. Empty if all are
// there.
std::string line_of_absent_types(const TypeList& types, const ReadingOptions& options,
                                 const std::string& file) {
    const std::vector<std::string>& there = types.words();
    if (there.empty()) return "";
    std::vector<std::string> absent;
    for (const auto& [word, name] : options.species)
        if (!types.place(word)) absent.push_back(excerpt(word));
    if (absent.empty()) return "";
    const std::string words = fmt::format(
        "--species names the type{} {}, which no grain of {} has; {}", absent.size() == 1 ? "" : "s",
        fmt::join(absent, ", "), file,
        there.size() == 1
            ? "its type is " + excerpt(there[0])
            : fmt::format("its types are {}", excerpt(fmt::format("{}", fmt::join(there, ", ")))));
    const bool numbers = std::all_of(there.begin(), there.end(), is_numbered);
    if (numbers && !std::all_of(absent.begin(), absent.end(), is_numbered)) throw UserError(words);
    return words;
}

}  // namespace

// The frames in which types are looked for; of many frames only some.
std::vector<std::size_t> ForeignArchive::looks() const {
    constexpr std::uintmax_t small = 32 << 20;  // bytes; so many are read in a moment
    constexpr std::size_t most = 64;
    std::uintmax_t bytes = 0;
    std::error_code ignored;
    for (const fs::path& file : grains_->files()) bytes += fs::file_size(file, ignored);
    const std::size_t frames = moments_.size();
    const bool all = bytes <= small || looks_ == Looks::first;
    const std::size_t stride = all ? 1 : std::max<std::size_t>(1, (frames + most - 1) / most);
    std::vector<std::size_t> looks;
    for (std::size_t k = 0; k < frames; k += stride) looks.push_back(k);
    if (frames > 0 && looks.back() != frames - 1) looks.push_back(frames - 1);
    return looks;
}

// Takes types and number of grains from a frame, and from the first with grains what its columns mean.
// Returns whether it has grains.
bool ForeignArchive::look_at(std::size_t index) {
    const RawFrame& frame = raw(index);
    world_.most_grains = std::max(world_.most_grains, frame.grains.rows);
    if (frame.grains.rows == 0) return false;
    if (!meaning_) {
        meaning_.emplace(grains_->facts(), frame, options_, grains_->files().front().string());
        first_with_grains_ = index;
    }
    meaning_->add_types(frame, types_);
    if (meaning_->least_id(frame) == 0) world_.first_id = 0;
    return true;
}

// Finds out which types there are, how many grains, and what the columns mean.
void ForeignArchive::survey() {
    const std::size_t frames = moments_.size();
    world_.first_id = 1;  // until a grain has the id 0
    for (const std::size_t k : looks())
        if (look_at(k) && looks_ == Looks::first) break;
    count_grains();
    if (looks_ != Looks::first)
        if (std::string absent = line_of_absent_types(types_, options_, path_.string()); !absent.empty())
            news_.push_back(std::move(absent));
    for (const auto& [word, name] : options_.species) types_.add(word);
    if (!meaning_) {
        // No frame has a grain, so the columns get the meaning of an empty table.
        RawFrame empty;
        empty.grains.columns = {{"id", {}}, {"x", {}}, {"y", {}}, {"z", {}}, {"radius", {}}};
        meaning_.emplace(grains_->facts(), empty, ReadingOptions(), path_.string());
        const bool contacts = std::any_of(grains_->moments().begin(), grains_->moments().end(),
                                          [](const RawMoment& one) { return one.has_contacts; });
        // A dump may have contacts now and grains later; a table has the same columns in all frames.
        if (contacts && grains_->facts().format.starts_with("table"))
            throw UserError(
                "{}: holds contacts and no grains; give the file of the grains, and name "
                "this one by --contacts",
                path_.string());
        news_.push_back(contacts
                            ? fmt::format("{}: has contacts and no grains; open the file of the grains, and "
                                          "name this one by --contacts",
                                          path_.string())
                            : fmt::format("{}: has no grain in any frame", path_.string()));
    }
    for (const std::string& line : meaning_->guesses()) news_.push_back(line);
    if (std::string stray = line_of_stray_type(types_, options_, path_.string()); !stray.empty())
        news_.push_back(std::move(stray));
    if (!meaning_->has_ids() && frames > 1)
        news_.push_back(fmt::format("{}: has no ids; its grains are counted by their rows", path_.string()));
    survey_contacts();
    if (has_contacts_) check_contact_columns();
}

void ForeignArchive::count_grains() {
    for (const RawMoment& moment : grains_->moments()) {
        world_.most_grains = std::max(world_.most_grains, static_cast<std::size_t>(moment.grains));
        world_.traffic = world_.traffic || moment.grains != grains_->moments().front().grains;
    }
}

// The step of the grains to which contacts belong. If one of both has only times, they are matched by time.
std::optional<std::int64_t> ForeignArchive::step_for_contacts(const RawMoment& contacts,
                                                              std::size_t moments) const {
    const std::vector<RawMoment>& grains = grains_->moments();
    if (grains.empty()) return std::nullopt;
    const bool timed = contacts.time && grains.front().time;
    if (timed && !(contacts.step && grains.front().step)) {
        for (std::size_t f = 0; f < grains.size(); ++f)
            if (grains[f].time &&
                std::abs(*grains[f].time - *contacts.time) <= 1e-6 * std::abs(*contacts.time) + 1e-12)
                return raw_steps_[f];
        return std::nullopt;
    }
    // A file of one moment that says no time belongs to grains of one moment.
    const bool alone = !contacts.step && !contacts.time && moments == 1 && grains.size() == 1;
    return alone ? std::optional(raw_steps_.front()) : contacts.step;
}

void ForeignArchive::survey_contacts() {
    contacts_at_.clear();
    const std::size_t frames = moments_.size();
    for (std::size_t k = 0; k < frames && !has_contacts_; ++k)
        has_contacts_ = grains_->moments()[k].has_contacts;
    if (!contacts_) return;
    const std::vector<RawMoment>& moments = contacts_->moments();
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const std::optional<std::int64_t> step = step_for_contacts(moments[k], moments.size());
        if (step) contacts_at_.emplace(*step, k);
    }
    const auto matched =
        static_cast<std::size_t>(std::count_if(raw_steps_.begin(), raw_steps_.end(), [&](std::int64_t step) {
            return contacts_at_.contains(step);
        }));
    has_contacts_ = matched > 0;
    const std::string name = contacts_->files().front().string();
    if (matched == 0)
        news_.push_back(
            fmt::format("{}: its contacts are left out: none of its moments is one of the grains", name));
    else if (matched < frames)
        news_.push_back(fmt::format("{}: has contacts of {} of the {} frames; the others are shown without",
                                    name, matched, frames));
}

// Columns of a dump local may have any names. If they do not tell which grains touch, contacts are left out.
void ForeignArchive::check_contact_columns() {
    const RawSeries& from = contacts_ ? *contacts_ : *grains_;
    for (std::size_t k = 0; k < from.moments().size(); ++k) {
        if (!from.moments()[k].has_contacts) continue;
        const RawTable contacts = from.read(k).contacts;
        if (contacts.rows == 0) continue;
        const std::string name = from.files().front().string();
        has_contacts_ =
            column_for("id1", contacts, options_, name) && column_for("id2", contacts, options_, name);
        if (has_contacts_) find_first_id_of_contacts();
        if (!has_contacts_)
            news_.push_back(fmt::format(
                "{}: its contacts are left out: no columns say who touches whom; name them as in --columns "
                "id1=c_1[1],id2=c_1[2],force=c_2[1]; it has {}",
                name, names_in(contacts)));
        return;
    }
}

// If the grains have no ids, they are counted by their rows from 1. Contacts may count them from 0.
void ForeignArchive::find_first_id_of_contacts() {
    rows_of_contacts_from_0_ = false;
    if (!contacts_ || meaning_->has_ids()) return;
    for (std::size_t k = 0; k < contacts_->moments().size() && !rows_of_contacts_from_0_; ++k) {
        const std::optional<std::vector<Link>> links =
            touches_of(contacts_->read(k), options_, meaning_->units(), contacts_->place(k));
        rows_of_contacts_from_0_ = links && std::any_of(links->begin(), links->end(), [](const Link& link) {
                                       return link.first == 0 || link.second == 0;
                                   });
    }
}

void ForeignArchive::make_world() {
    world_.title = path_.filename().string();
    world_.program_version = grains_->facts().program;
    make_species();
    add_box();
}

// Makes the bodies of the world, which have different names.
void ForeignArchive::name_walls() {
    world_.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    std::set<std::string> names;
    for (MovingWall& wall : walls_) {
        std::string name = wall.name.empty() ? "wall" : wall.name;
        for (int k = 2; names.count(name) > 0; ++k)
            name = fmt::format("{} {}", wall.name.empty() ? "wall" : wall.name, k);
        names.insert(name);
        wall.name = name;
        world_.bodies.push_back({name, {}, wall.shape});
    }
}

// The species of the types, with sizes, densities and box of the first frame that has grains.
void ForeignArchive::make_species() {
    world_.species.clear();
    for (const std::string& word : types_.words()) {
        WorldSpecies& species = world_.species.emplace_back();
        const auto named = options_.species.find(word);
        species.name = named != options_.species.end() ? named->second
                       : is_numbered(word)             ? "type " + word
                                                       : word;
    }
    if (world_.species.empty()) world_.species.emplace_back().name = "grains";
    std::size_t first = 0;
    while (first + 1 < moments_.size() && grains_->moments()[first].grains == 0) ++first;
    if (!moments_.empty() && types_.words().size() > 0) {
        const RawFrame& frame = raw(first);
        const std::vector<double> densities = meaning_->densities(frame, types_);
        Gaps ignored;
        const State grains = meaning_->frame(frame, types_, grains_->place(first), ignored);
        std::vector<double> sums(types_.words().size(), 0);
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const auto species = static_cast<std::size_t>(grains.species[i]);
            sums[species] += 2 * grains.radius[i];
            ++world_.species[species].count;
        }
        for (std::size_t s = 0; s < sums.size(); ++s) {
            if (world_.species[s].count > 0)
                world_.species[s].diameter = sums[s] / static_cast<double>(world_.species[s].count);
            world_.species[s].density = densities[s];
        }
        world_.cell = meaning_->cell(frame);
    }
}

}  // namespace grainreel
