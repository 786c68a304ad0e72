// What a run was before it goes on in its folder. All that is going to be cut or replaced is kept in a hidden
// folder of the run until the run has gone past its former end. A run that fails before is put back as it
// was; one that was killed, by whoever takes it up next.
//
// A file that is put in the place of another costs nothing: the old one gets a second name. Of a file that
// grows the end is copied, or its beginning where that is shorter.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

class FormerRun {
  public:
    // Takes the run in a folder. Nothing of it changes before begin(). Throws RunError.
    explicit FormerRun(std::filesystem::path run);
    ~FormerRun();
    FormerRun(const FormerRun&) = delete;
    FormerRun& operator=(const FormerRun&) = delete;

    // A growing file of which so many bytes stay.
    void cut(const std::string& name, std::uintmax_t bytes) { cuts_.push_back({name, bytes, {}}); }
    // For a NetCDF file, which says itself how many records it has.
    void cut(const std::string& name, const KeptRecords& kept) {
        cuts_.push_back({name, kept.bytes, kept.records});
    }
    // Where a file is to be made that takes the place of one that grows.
    std::filesystem::path new_file(const std::string& name);

    // Keeps all that there is. Afterwards the new files are in their places, and the others may be cut and
    // replaced. Throws RunError, and the run is as it was then.
    void begin();

    // The run has gone past its former end.
    static void let_go(const std::filesystem::path& run);
    // Whether there is something to put back.
    static bool is_kept(const std::filesystem::path& run);
    // Does so. No file of the run may be open. Throws RunError where it fails, and may be called again.
    static void put_back(const std::filesystem::path& run);

  private:
    struct Cut {
        std::string name;
        std::uintmax_t bytes = 0;
        std::optional<std::size_t> records{};
    };
    void keep_growing(const Cut& cut);
    std::string keep_whole() const;

    std::filesystem::path run_, part_;
    std::vector<Cut> cuts_;
    std::vector<std::string> new_files_;
};

}  // namespace grainreel
