// What an AMBER NetCDF file declares, over the netCDF library: the group it lies in, its dimensions and its
// variables. Damage that the library would not survive is looked for before.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// A variable of numbers. `per_frame` and `per_grain` say which of the file's dimensions it runs over;
// `components` is what is left.
struct AmberVariable {
    std::string name, units;
    int id = -1;
    bool per_frame = false, per_grain = false;
    std::size_t components = 1;
    bool single = true;  // no dimension of components, not even one of length 1
    double scale = 1;    // scale_factor
    double fill = 0;     // what stands where nothing was written
};

class AmberVariables {
  public:
    // Throws UserError when the file cannot be read or has no places of grains.
    explicit AmberVariables(const std::filesystem::path& file);
    ~AmberVariables();
    AmberVariables(const AmberVariables&) = delete;
    AmberVariables& operator=(const AmberVariables&) = delete;

    std::size_t frames() const { return frames_; }      // that lie whole in the file
    std::size_t declared() const { return declared_; }  // that it says it has
    // How many there is room for behind a header that counts none; none where the file has no records.
    std::optional<std::size_t> records_behind_header() const;
    int count_bytes() const;                        // of the number of records in the header, from byte 4 on
    std::size_t grains() const { return grains_; }  // for which there is room in a frame
    const std::vector<AmberVariable>& variables() const { return variables_; }
    const AmberVariable* find(const std::string& name) const;
    const AmberVariable& places() const { return variables_[places_]; }
    std::string attribute(const char* name) const;  // of the file; empty where there is none

    // The numbers of a frame, of the first `grains` grains, as they stand in the file: not scaled.
    std::vector<double> read(const AmberVariable& variable, std::size_t frame, std::size_t grains) const;

  private:
    void find_group();
    void find_dimensions();
    void add_variable(int id);
    std::size_t whole_records() const;
    void check(int status) const;

    std::filesystem::path file_;
    int file_id_ = -1, id_ = -1;  // of the file and of the group
    int frame_dimension_ = -1, atom_dimension_ = -1;
    std::size_t frames_ = 1, declared_ = 1, grains_ = 0, places_ = 0;
    std::vector<AmberVariable> variables_;
};

// Work that may crash, tried in a child process first. The HDF5 library follows the pointers of a damaged
// file wherever they lead; whoever opens one must not end with it.

// Does `work` in a copy of this process, for up to so many seconds. Whether the copy lived to its end; what
// it changed is gone, and an exception counts as an end. True also where no copy can be made.
bool survives(const std::function<void()>& work, unsigned seconds);

}  // namespace grainreel
