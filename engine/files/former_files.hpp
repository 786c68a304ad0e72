// Keeps a run as it was while it is continued in its folder. A run that is continued loses what lies after
// the moment from which it goes on. The lost part stays in a hidden folder of the run until the continuation
// has passed the run's former end. If the continuation fails before, the run is put back as it was. If its
// process is killed, the next process that uses the run puts it back.
//
// A file that will be replaced gets a second name (a hard link) there. The end of a file that grows is copied
// before it is cut. If the beginning is shorter than the end, the beginning is copied instead, to a new file
// that replaces the old one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

class FormerFiles {
  public:
    // run: its folder. Nothing in it changes before begin(). Throws RunError.
    explicit FormerFiles(std::filesystem::path run);
    ~FormerFiles();
    FormerFiles(const FormerFiles&) = delete;
    FormerFiles& operator=(const FormerFiles&) = delete;

    // Names a growing file that the caller will cut after begin(), and how many bytes of it stay.
    void cut(const std::string& name, std::uintmax_t bytes) { cuts_.push_back({name, bytes, {}}); }
    // The same for a NetCDF file, whose header says how many records it has.
    void cut(const std::string& name, const KeptRecords& kept) {
        cuts_.push_back({name, kept.bytes, kept.records});
    }
    // Returns the path at which the caller makes a new file. begin() puts it in the place of the growing file
    // of this name.
    std::filesystem::path new_file(const std::string& name);

    // Keeps the run as it is. Afterwards the new files are in their places, and the others may be cut and
    // replaced. If this throws RunError, the run is unchanged.
    void begin();

    // Removes what was kept. To be called when the run has passed its former end.
    static void let_go(const std::filesystem::path& run);
    // Whether something is kept that can be put back.
    static bool is_kept(const std::filesystem::path& run);
    // Puts the run back as it was. No file of the run may be open. If this throws RunError, it may be called
    // again.
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
