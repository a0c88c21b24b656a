// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "emulated-ui/rehearsal/proofs.h"
#include "project/document.h"

namespace standpoint {

// What follows from the setups, links and fitted targets that a device has, without a look into the files:
//   links.closure, links.wrong             the chain of the links, and those that are far from the truth
//   targets.distances                      between the fitted centres, against the truth
//   control.*                              the newest setup laid onto the known places of its targets
//   sights.*, orientation.error            targets that were picked one by one, and the station solved from them
//   repeats.*                              of setups that were repeated at one place
const std::vector<ProofRow>& fieldProofRows();
std::optional<Fact> fieldProof(const std::string& name, const Device& device, const Document& document);

// Of a walk with a handheld scanner that was planned: x, y, seconds. None of them is there before.
const std::vector<ProofRow>& walkProofRows();
std::optional<Fact> walkProof(const std::string& name, const Exercise& exercise, const WalkedWay& planned,
                              const Device& device);

// Facts with a name of their own: "place.door" of an exercise's places: metres from there to the nearest setup, in
// plan; "walk.near.corner": metres from there to the nearest spot of the planned walk; "expected.reach.10": the range
// at which half of the pulses come back from a surface that returns 10 %; "expected.sigma.25.10": σ of the range in mm
// at 25 m on a surface that returns 10 %, with the device's settings.
std::optional<Fact> namedProof(const std::string& name, const Exercise& exercise, const Device& device,
                               const Document& document);
std::optional<FactDomain> namedProofDomain(const std::string& name, const Exercise& exercise);

}  // namespace standpoint
