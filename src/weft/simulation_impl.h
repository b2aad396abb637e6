// What is behind the public Simulation.
#pragma once

#include "weft/session.h"

#include <weft/simulation.h>

#include <vector>

namespace weft {

struct Simulation::Impl {
    Session session;
    mutable DrawnFrame drawn = {};
    mutable bool drawn_is_old = true;

    World& world() { return session.world(); }
    const World& world() const { return session.world(); }
    /// Of the frame as it is; they come from the device when somebody asks for them.
    std::span<const ExportSurface> surfaces() const {
        if (drawn_is_old) drawn.update(world().frame(), session.scene().looks);
        drawn_is_old = false;
        return drawn.surfaces();
    }
    void changed() { drawn_is_old = true; }

    /// What Simulation::load and create do, with another backend than the options' if there is a `make`.
    static Result<Simulation> load(const std::filesystem::path& scene, const Options& options,
                                   const Session::MakeBackend& make);
    static Result<Simulation> create(const WorldDesc& world, const Options& options, const Session::MakeBackend& make);
};

}  // namespace weft
