// Reads lists of VTK files: .pvd and .series of ParaView, .vtm of VTK and LIGGGHTS. For each time in the list
// there is a frame, made of one or several files (vtk_parts.hpp).

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/vtk_parts.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The files of one time.
struct CollectionMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::vector<VtkPartFile> files{};
    bool operator==(const CollectionMoment&) const = default;
};

// The moments that a list names. A .vtm has only one.
struct CollectionList {
    std::string format;
    std::string program{};
    std::vector<CollectionMoment> moments{};
    // Number of files that a later line names again for the same time; the later line counts.
    std::int64_t replaced = 0;
};

// One file as the list names it.
struct Entry {
    std::optional<double> time{};
    std::string part{}, group{}, file{}, name{};
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// "walls_#.vtp" for "walls_0012.vtp". Files of one series have the same stem.
std::string stem_of(std::string_view name) {
    std::string stem;
    for (std::size_t i = 0; i < name.size(); ++i)
        if (!is_digit(name[i]))
            stem += name[i];
        else if (i == 0 || !is_digit(name[i - 1]))
            stem += '#';
    return stem;
}

// The last whole number in a file's name: 2000 for "dump2000.vtm".
std::optional<std::int64_t> number_in_name(const std::string& file) {
    const std::string stem = fs::path(file).stem().string();
    std::size_t end = stem.size();
    while (end > 0 && !is_digit(stem[end - 1])) --end;
    std::size_t begin = end;
    while (begin > 0 && is_digit(stem[begin - 1])) --begin;
    return begin == end ? std::nullopt : whole_in(std::string_view(stem).substr(begin, end - begin));
}

// Whether LIGGGHTS wrote the list. It puts the number of the frame (0, 1, 2, ...) in place of a time; all
// files are .vtm, with part 0 and no group.
bool is_of_liggghts(const XmlElement& root, const std::vector<Entry>& entries) {
    if (entries.empty() || root.attribute("header_type") != "UInt64") return false;
    double next = 0;
    for (const Entry& entry : entries)
        if (entry.time != next++ || entry.part != "0" || !entry.group.empty() ||
            !entry.file.ends_with(".vtm"))
            return false;
    return true;
}

bool same_parts(const std::vector<Entry>& entries) {
    return std::all_of(entries.begin(), entries.end(),
                       [&](const Entry& entry) { return entry.part == entries[0].part; });
}
bool same_stems(const std::vector<Entry>& entries) {
    return std::all_of(entries.begin(), entries.end(),
                       [&](const Entry& entry) { return stem_of(entry.file) == stem_of(entries[0].file); });
}

// Entries with the same time are one moment; a later entry with the same part, group and stem replaces an
// earlier one. In a list without times each file is a moment if all have the same part and the same stem;
// otherwise all files together are one moment.
void group(const fs::path& folder, const std::vector<Entry>& entries, CollectionList& list) {
    const bool timeless = std::none_of(entries.begin(), entries.end(),
                                       [](const Entry& entry) { return entry.time.has_value(); });
    const bool a_moment_each = timeless && same_parts(entries) && same_stems(entries);
    std::map<double, std::size_t> moment_of;
    std::map<std::tuple<std::size_t, std::string, std::string, std::string>, std::size_t> file_of;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        const double key = a_moment_each ? static_cast<double>(i) : entry.time.value_or(0);
        const auto [found, fresh] = moment_of.try_emplace(key, list.moments.size());
        if (fresh) list.moments.push_back({std::nullopt, entry.time, {}});
        std::vector<VtkPartFile>& files = list.moments[found->second].files;
        const VtkPartFile file{folder / entry.file, entry.name};
        const auto [place, first] =
            file_of.try_emplace({found->second, entry.part, entry.group, stem_of(entry.file)}, files.size());
        if (first) {
            files.push_back(file);
        } else if (!timeless) {
            files[place->second] = file;
            ++list.replaced;
        } else {
            files.push_back(file);
        }
    }
}

void find_entries(const fs::path& file, const XmlElement& element, std::vector<Entry>& entries) {
    for (const XmlElement& child : element.children) {
        if (child.name != "DataSet") {
            find_entries(file, child, entries);
            continue;
        }
        Entry entry;
        entry.part = child.attribute("part");
        entry.group = child.attribute("group");
        entry.file = named_file(file.parent_path(), child.attribute("file"));
        entry.name = child.has("name") ? child.attribute("name") : child.attribute("group");
        if (entry.file.empty()) refuse_line(file, child.line, "a DataSet without a file");
        const std::string_view time = child.attribute("timestep");
        if (WordReader words(time); words.has_word()) {
            entry.time = words.next_number();
            if (!entry.time || !std::isfinite(*entry.time))
                refuse_line(file, child.line, fmt::format("timestep=\"{}\" is no time", excerpt(time)));
        }
        entries.push_back(std::move(entry));
    }
}

CollectionList list_of_pvd(const fs::path& file) {
    // While the list is being written it may end anywhere.
    const XmlTree tree = xml_tree(Content(file), true);
    CollectionList list;
    list.format = "ParaView collection (.pvd)";
    std::vector<Entry> entries;
    find_entries(file, tree.root, entries);
    const bool numbered = is_of_liggghts(tree.root, entries);
    group(file.parent_path(), entries, list);
    if (!numbered) return list;
    list.program = "LIGGGHTS";
    for (std::size_t i = 0; i < list.moments.size(); ++i) {
        list.moments[i].time.reset();
        list.moments[i].step = number_in_name(entries[i].file);
    }
    return list;
}

constexpr std::uint64_t largest_list = std::uint64_t{8} << 20;  // bytes of a list in JSON

CollectionList list_of_series(const fs::path& file, const std::string& bytes) {
    nlohmann::json series;
    try {
        series = nlohmann::json::parse(bytes);
    } catch (const nlohmann::json::parse_error& error) {
        refuse_line(file, line_of_byte(bytes, error.byte), "is no valid JSON here; write it again");
    }
    const auto files = series.find("files");
    if (files == series.end() || !files->is_array()) refuse_file(file, "its list \"files\" is missing");
    std::vector<Entry> entries;
    for (const nlohmann::json& each : *files) {
        const auto name = each.is_object() ? each.find("name") : each.end();
        if (!each.is_object() || name == each.end() || !name->is_string())
            refuse_file(file,
                        fmt::format("entry {} of its list \"files\" has no \"name\"", entries.size() + 1));
        Entry entry;
        entry.file = named_file(file.parent_path(), name->get<std::string>());
        const auto time = each.find("time");
        if (time != each.end() && time->is_number()) entry.time = time->get<double>();
        entries.push_back(std::move(entry));
    }
    CollectionList list;
    list.format = "ParaView series (.series)";
    group(file.parent_path(), entries, list);
    return list;
}

bool is_series(std::string_view bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{' &&
           (bytes.find("\"file-series-version\"") != std::string_view::npos ||
            (bytes.find("\"files\"") != std::string_view::npos &&
             bytes.find("\"name\"") != std::string_view::npos));
}

// Reads a list. Its moments are in the order in which their times first appear. Throws UserError with the
// line.
CollectionList collection_list(const fs::path& file) {
    const std::string type = vtk_file_type(unpacked_head(file).bytes);
    if (is_block_type(type)) return {"VTK blocks (.vtm)", {}, {{{}, {}, {{file, ""}}}}};
    CollectionList list =
        type.empty() ? list_of_series(file, all_bytes(file, largest_list)) : list_of_pvd(file);
    if (list.moments.empty()) refuse_file(file, "this collection names no files");
    return list;
}

// Whether a file begins as a list of VTK files does.
bool takes_collection(const FileStart& head) {
    const std::string type = vtk_file_type(head.bytes);
    return type == "Collection" || is_block_type(type) || (type.empty() && is_series(head.bytes));
}

bool is_there(const VtkPartFile& file) {
    return is_plain(file.file);
}

class VtkCollection : public RawFile {
  public:
    explicit VtkCollection(fs::path file) : RawFile(std::move(file)), list_(collection_list(file_)) {
        facts_.format = list_.format;
        facts_.program = list_.program;
        if (list_.replaced > 0)
            news_.push_back(
                fmt::format("{}: names {} files again for a time that it had; the later ones count",
                            shown(file_), list_.replaced));
        take_moments();
        if (moments_.empty()) refuse();
    }

    RawFrame read(std::size_t index) const override {
        const CollectionMoment& moment = list_.moments[taken_[index]];
        VtkParts parts;
        for (const VtkPartFile& file : moment.files)
            if (is_there(file)) add_part(file, VtkPart::all, parts);
        parts.frame.time = moments_[index].time;
        parts.frame.step = moments_[index].step;
        return std::move(parts.frame);
    }

    bool grows() const override { return true; }
    bool grow() override {
        CollectionList list = collection_list(file_);
        const std::size_t done = taken_.empty() ? 0 : taken_.back() + 1;
        if (list.moments.size() < done ||
            !std::equal(list.moments.begin(), list.moments.begin() + done_of(done), list_.moments.begin()))
            refuse_file(file_, "was replaced by another list while it was read; start again");
        list_ = std::move(list);
        const std::size_t before = moments_.size();
        take_moments();
        return moments_.size() > before;
    }

  private:
    static std::ptrdiff_t done_of(std::size_t count) { return static_cast<std::ptrdiff_t>(count); }

    // Takes further moments, up to the last one that is whole: all of its files are there. The files of later
    // ones may still be missing because the run goes on. A moment before it is taken with the files that are
    // there.
    void take_moments() {
        const std::vector<CollectionMoment>& all = list_.moments;
        const auto whole = [](const CollectionMoment& moment) {
            return std::all_of(moment.files.begin(), moment.files.end(), is_there);
        };
        const auto last = std::find_if(all.rbegin(), all.rend(), whole);
        // If no moment is whole, all are taken.
        const std::size_t end = last == all.rend() ? all.size() : static_cast<std::size_t>(all.rend() - last);
        Missing missing;
        for (std::size_t i = taken_.empty() ? 0 : taken_.back() + 1; i < all.size(); ++i) {
            const bool any = std::any_of(all[i].files.begin(), all[i].files.end(), is_there);
            for (const VtkPartFile& file : all[i].files)
                if (!is_there(file)) missing.add(file.file);
            if (i < end && any) take(i);
        }
        say(missing);
    }

    struct Missing {
        std::size_t count = 0;
        fs::path first{};
        void add(const fs::path& file) {
            if (count++ == 0) first = file;
        }
    };

    void say(const Missing& missing) {
        first_missing_ = missing.first;
        if (missing.count == 0 || moments_.empty() || said_missing_) return;
        said_missing_ = true;
        news_.push_back(
            fmt::format("{}: {} of the files that it names are not there, the first is \"{}\"; they are "
                        "left out",
                        shown(file_), missing.count, shown(missing.first)));
    }

    void take(std::size_t index) {
        const CollectionMoment& moment = list_.moments[index];
        VtkParts parts;
        try {
            // The files of the last moment are always read, so that one that is cut off is noticed.
            const bool last = index + 1 == list_.moments.size();
            for (const VtkPartFile& file : moment.files)
                if (is_there(file) && (last || !count_by_head(file, moment.time.has_value(), parts)))
                    add_part(file, VtkPart::cells, parts);
        } catch (const UserError& error) {
            if (complaint_.empty())
                news_.push_back(fmt::format("{}: left out is {}", shown(file_), error.what()));
            complaint_ = error.what();
            return;
        }
        if (parts.grids > 0) pass_over(parts.grid);
        const RawMoment& held = parts.moment;
        if (parts.grids > 0 && held.grains == 0 && !held.has_contacts && !held.has_walls && !parts.frame.box)
            return;
        if (!parts.program.empty()) facts_.program = parts.program;
        if (parts.missing > 0 && !said_missing_) {
            said_missing_ = true;
            news_.push_back(
                fmt::format("{}: {} of the files that a list of blocks names are not there; they are left "
                            "out",
                            shown(file_), parts.missing));
        }
        if (moment.time) parts.moment.time = moment.time;
        if (moment.step) parts.moment.step = moment.step;
        taken_.push_back(index);
        moments_.push_back(parts.moment);
    }

    void pass_over(const fs::path& grid) {
        if (grid_.empty())
            news_.push_back(fmt::format("{}: its grids (\"{}\") are no grains and are passed over",
                                        shown(file_), shown(grid.filename())));
        grid_ = grid;
    }

    [[noreturn]] void refuse() const {
        if (!complaint_.empty()) throw UserError(complaint_);
        if (!grid_.empty())
            refuse_file(file_,
                        fmt::format("holds a grid, not grains (\"{}\"); give a file of points or surfaces",
                                    shown(grid_.filename())));
        refuse_file(file_, fmt::format("names files, and \"{}\" is not there; copy its files beside it",
                                       shown(first_missing_)));
    }

    CollectionList list_;
    std::vector<std::size_t> taken_{};  // numbers in list_.moments
    std::string complaint_{};
    fs::path first_missing_{}, grid_{};
    bool said_missing_ = false;
};

std::unique_ptr<RawFile> open_vtk_collection(const fs::path& file) {
    return std::make_unique<VtkCollection>(file);
}

}  // namespace

RawFormat vtk_collection_format() {
    return {"vtk-collection", "lists of VTK files (.pvd, .vtm, .series)", &takes_collection,
            &open_vtk_collection};
}

}  // namespace grainreel
