// Writes an HDF5 file with groups, attributes and tables that grow by rows. The same calls make the same
// bytes. Only one thread at a time may use it, and must hold hdf5_library() (hdf5_trial.hpp), also while it
// goes away. All functions throw RunError where the file cannot be written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace grainreel {

class Hdf5Tables {
  public:
    explicit Hdf5Tables(const std::filesystem::path& file);
    Hdf5Tables(const Hdf5Tables&) = delete;
    Hdf5Tables& operator=(const Hdf5Tables&) = delete;

    // Makes a group. ordered: its members are listed as they were made, not by the alphabet.
    void add_group(const std::string& path, bool ordered = false);
    // A second name of an object of this file.
    void add_link(const std::string& target, const std::string& path);
    // Attributes of a group.
    void set_word(const std::string& path, const std::string& name, const std::string& word);
    void set_numbers(const std::string& path, const std::string& name,
                     const std::vector<std::int64_t>& values);

    // Adds rows to a table, which is made if it is not there. type: as of a VtkList. columns: 0 for a table
    // of one dimension. bytes: the numbers as they lie in memory, which may be none. Returns the number of
    // the first new row.
    std::int64_t append(const std::string& path, const std::string& type, std::size_t columns,
                        const std::string& bytes);
    std::int64_t append(const std::string& path, const std::vector<std::int64_t>& values,
                        std::size_t columns = 0);
    std::int64_t append(const std::string& path, const std::vector<double>& values, std::size_t columns = 0);
    // A table of words. VTK cannot read words that are marked as UTF-8, so these are not.
    void add_words(const std::string& path, const std::vector<std::string>& words);
    // Whether append() has made the table.
    bool has(const std::string& path) const { return tables_.count(path) > 0; }
    std::int64_t rows(const std::string& path) const;
    // Writes all to the disk. Nothing may be called afterwards.
    void close();

  private:
    struct Table {
        std::shared_ptr<void> data;
        std::size_t columns = 0, item = 0;  // bytes of a number
        std::uint64_t rows = 0;
    };
    [[noreturn]] void fault() const;
    std::shared_ptr<void> checked(std::shared_ptr<void> handle) const;
    void check(bool good) const;
    Table& table(const std::string& path, const std::string& type, std::size_t columns, std::uint64_t rows);
    void attribute(const std::string& path, const std::string& name, std::int64_t type,
                   const std::shared_ptr<void>& space, const void* value) const;

    std::filesystem::path path_;
    bool failed_ = false;  // whether a write went wrong
    std::shared_ptr<void> file_;
    std::map<std::string, Table> tables_;
};

}  // namespace grainreel
