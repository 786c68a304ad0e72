// Every observer of measures.csv, in the order of the columns. A new observer is a class beside its formulas;
// its include and its name are added here.
//
// Two files read this list. columns.cpp uses only static members of each observer, so it needs no step loop.
// observers.cpp makes the observers.
#pragma once

#include "engine/measure/bed/bed_observers.hpp"
#include "engine/measure/drive_observers.hpp"
#include "engine/measure/energy_observers.hpp"
#include "engine/measure/fields/coarse_graining_observer.hpp"
#include "engine/measure/flow/drift.hpp"
#include "engine/measure/flow/outflow_observer.hpp"
#include "engine/measure/segregation/segregation_observers.hpp"
#include "engine/measure/surface/surface_observers.hpp"
#include "engine/measure/walls/wall_forces_observer.hpp"
#include "engine/measure/walls/wear_observer.hpp"

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
                                  observers::Drum,              //
                                  observers::Wear,              //
                                  observers::CoarseGrainedFields>;

}  // namespace grainreel
