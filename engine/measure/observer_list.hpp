// Every observer of measures.csv, in the order of the columns. A new one is its file and its name here.
//
// Both libraries read this list: grainreel_scene, which knows the columns where a scene is read, takes only
// columns() from it, and grainreel_core makes the observers.
#pragma once

#include "engine/measure/observers/bed/bed_motion.hpp"
#include "engine/measure/observers/bed/bed_periods.hpp"
#include "engine/measure/observers/bed/bed_shape.hpp"
#include "engine/measure/observers/bed/fabric.hpp"
#include "engine/measure/observers/bed/intruder.hpp"
#include "engine/measure/observers/centre_of_mass.hpp"
#include "engine/measure/observers/coarse_grained_fields.hpp"
#include "engine/measure/observers/contact_number.hpp"
#include "engine/measure/observers/drive_now.hpp"
#include "engine/measure/observers/energies.hpp"
#include "engine/measure/observers/energy_shares.hpp"
#include "engine/measure/observers/floor_position.hpp"
#include "engine/measure/observers/flow/convection.hpp"
#include "engine/measure/observers/flow/outflow.hpp"
#include "engine/measure/observers/largest_overlap.hpp"
#include "engine/measure/observers/segregation/big_above_small.hpp"
#include "engine/measure/observers/segregation/big_at_walls.hpp"
#include "engine/measure/observers/segregation/big_in_quarters.hpp"
#include "engine/measure/observers/segregation/height_difference.hpp"
#include "engine/measure/observers/segregation/mixing.hpp"
#include "engine/measure/observers/segregation/unlike.hpp"
#include "engine/measure/observers/species_places.hpp"
#include "engine/measure/observers/surface/bed_surface.hpp"
#include "engine/measure/observers/times.hpp"
#include "engine/measure/observers/walls/wall_forces.hpp"

namespace grainreel {

template <class... Each>
struct ObserverList {};

using RowObservers = ObserverList<observers::Times,             //
                                  observers::Energies,          //
                                  observers::CentreOfMass,      //
                                  observers::SpeciesPlaces,     //
                                  observers::HeightDifference,  //
                                  observers::BigAboveSmall,     //
                                  observers::BigInQuarters,     //
                                  observers::BigAtWalls,        //
                                  observers::Unlike,            //
                                  observers::Mixing,            //
                                  observers::ContactNumber,     //
                                  observers::ContactFabric,     //
                                  observers::LargestOverlap,    //
                                  observers::FloorPosition,     //
                                  observers::BedPeriods,        //
                                  observers::DriveNow,          //
                                  observers::EnergyShares,      //
                                  observers::BedShape,          //
                                  observers::BedMotion,         //
                                  observers::BedSurface,        //
                                  observers::Convection,        //
                                  observers::Intruder,          //
                                  observers::Outflow,           //
                                  observers::WallForces,        //
                                  observers::CoarseGrainedFields>;

}  // namespace grainreel
