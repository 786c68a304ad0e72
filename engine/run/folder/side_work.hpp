// What is made in a run's folder beside the run itself, on threads of its own: a film.
#pragma once

#include "engine/files/run_json.hpp"

namespace grainreel {

class SideWork {
  public:
    virtual ~SideWork() = default;
    // Begun, and neither closed nor dropped.
    virtual bool is_open() const = 0;
    // For the sentence "stopping: finishing the film".
    virtual const char* name() const = 0;
    // Finishes it; in a hurry, or when the folder is gone, leaves it as it is. Notes a failure and throws
    // nothing. Nothing happens where it is not open.
    virtual void close() = 0;
    // The run is put back as it was; nothing else is called afterwards.
    virtual void drop() = 0;
    // What run.json says of it: before it is begun, while it is open, and when it is closed.
    virtual void describe(RunRecord& record) const = 0;
};

}  // namespace grainreel
