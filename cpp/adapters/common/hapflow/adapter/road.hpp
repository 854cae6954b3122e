// Which way an adapter goes to libhapflow: hapflow.hpp over the C interface, or with HAPFLOW_VIA_CXX the cxx bridge.
#ifndef HAPFLOW_ADAPTER_ROAD_HPP
#define HAPFLOW_ADAPTER_ROAD_HPP

#include <hapflow/hapflow.hpp>

#ifdef HAPFLOW_VIA_CXX
#include <hapflow/cxx.hpp>
#endif

#include <type_traits>
#include <utility>

namespace hapflow::adapter {

/// The session that the adapters are written over. In a name of its own for each road, so that parts of a program that
/// were built over different ones do not link to each other.
#ifdef HAPFLOW_VIA_CXX
inline namespace via_cxx {
struct Road {
    using Session = hapflow::cxx::Session;
};
} // namespace via_cxx
#else
inline namespace via_c {
struct Road {
    using Session = hapflow::Session;
};
} // namespace via_c
#endif

/// The concept: what a road's session must have. On a servo thread nothing may throw.
template <class Session>
inline constexpr bool is_session =
    std::is_constructible_v<Session, const Config&> &&
    std::is_same_v<decltype(std::declval<Session&>().tick(std::declval<const ToolState&>())), Tick> &&
    noexcept(std::declval<Session&>().tick(std::declval<const ToolState&>())) &&
    noexcept(std::declval<Session&>().move_obstacle(0u, std::declval<const Vec3&>())) &&
    noexcept(std::declval<Session&>().publish_obstacles());
static_assert(is_session<Road::Session>, "a road whose session can be ticked by a servo");

} // namespace hapflow::adapter

#endif
