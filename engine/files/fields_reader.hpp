// fields.nc (engine/files/fields_file.hpp) read record by record: those fields whose axes are places.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace grainreel {

class FieldsReader {
  public:
    // The middles of the cells along x, y and z (m). An axis that the fields are means along has none.
    using Middles = std::array<std::vector<double>, 3>;

    // Throws UserError when the file is missing, damaged or no fields.nc, or its cells are not evenly spaced.
    // What a killed run left is read.
    explicit FieldsReader(const std::filesystem::path& path);
    ~FieldsReader();

    const Middles& middles() const;
    // Size of a cell along each axis, m; 0 where the fields are means along that axis.
    std::array<double, 3> cell() const;
    const std::vector<std::string>& names() const;  // "density"
    std::size_t records() const;
    std::array<double, 2> span(std::size_t record) const;  // s, where the record begins and ends

    // A list of values a name, x running fastest, then y; NaN where there is none. Throws UserError where the
    // record's checksum is not that of its numbers.
    std::vector<std::vector<double>> read(std::size_t record) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
