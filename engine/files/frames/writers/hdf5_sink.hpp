// How HDF5 writes our files. After a write of the library's own driver has failed, as on a full disk, the
// library can neither close the file nor end: it crashes when the program exits. This driver tells the
// library that each write went well, and remembers the first that did not.
#pragma once

#include <hdf5.h>

namespace grainreel {

// Lets a file that is created with these properties be written so. failed: becomes true with the first write
// that fails; must outlive the file. Returns false where the library refuses.
bool write_through_sink(hid_t file_properties, bool& failed);

}  // namespace grainreel
