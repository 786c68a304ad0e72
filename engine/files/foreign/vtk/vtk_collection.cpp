// Lists of VTK's files: .pvd and .series of ParaView, .vtm of VTK and LIGGGHTS.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/vtk/collection_list.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/xml_head.hpp"

namespace grainreel {

RawFormat vtk_collection_format();

namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& file) {
    return excerpt(file.string(), 400);
}

bool is_there(const VtkPartFile& file) {
    return is_plain(file.file);
}

class VtkCollection : public RawFile {
  public:
    explicit VtkCollection(fs::path file) : file_(std::move(file)), list_(collection_list(file_)) {
        facts_.format = list_.format;
        facts_.program = list_.program;
        if (list_.replaced > 0)
            news_.push_back(
                fmt::format("{}: names {} files again for a time that it had; the later ones count",
                            shown(file_), list_.replaced));
        take_moments();
        if (moments_.empty()) refuse();
    }

    const RawFacts& facts() const override { return facts_; }
    const std::vector<RawMoment>& moments() const override { return moments_; }
    std::vector<std::string> news() const override { return news_; }

    RawFrame read(std::size_t index) const override {
        const CollectionMoment& moment = list_.moments[taken_[index]];
        VtkParts parts;
        for (const VtkPartFile& file : moment.files)
            if (is_there(file)) add_part(file, VtkPart::all, parts);
        parts.frame.time = moments_[index].time;
        parts.frame.step = moments_[index].step;
        return std::move(parts.frame);
    }

    bool grow() override {
        CollectionList list = collection_list(file_);
        const std::size_t done = taken_.empty() ? 0 : taken_.back() + 1;
        if (list.moments.size() < done ||
            !std::equal(list.moments.begin(), list.moments.begin() + done_of(done), list_.moments.begin()))
            refuse_vtk_file(file_, "was replaced by another list while it was read; start again");
        list_ = std::move(list);
        const std::size_t before = moments_.size();
        take_moments();
        return moments_.size() > before;
    }

  private:
    static std::ptrdiff_t done_of(std::size_t count) { return static_cast<std::ptrdiff_t>(count); }

    // Those behind the last that was taken. A moment is whole when all of its files are there.
    void take_moments() {
        const std::vector<CollectionMoment>& all = list_.moments;
        const auto whole = [](const CollectionMoment& moment) {
            return std::all_of(moment.files.begin(), moment.files.end(), is_there);
        };
        const auto last = std::find_if(all.rbegin(), all.rend(), whole);
        // Where none is whole, the moments are taken by the files that they have.
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
        const RawMoment& found = parts.moment;
        if (parts.grids > 0 && found.grains == 0 && !found.has_contacts && !found.has_walls &&
            !parts.frame.box)
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
            refuse_vtk_file(
                file_, fmt::format("holds a grid, not grains (\"{}\"); give a file of points or surfaces",
                                   shown(grid_.filename())));
        refuse_vtk_file(file_, fmt::format("names files, and \"{}\" is not there; copy its files beside it",
                                           shown(first_missing_)));
    }

    fs::path file_;
    CollectionList list_;
    RawFacts facts_{};
    std::vector<RawMoment> moments_{};
    std::vector<std::size_t> taken_{};  // of list_.moments
    std::vector<std::string> news_{};
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
