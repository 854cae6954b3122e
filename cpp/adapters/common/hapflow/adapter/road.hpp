// Which way an adapter goes to libhapflow. HAPFLOW_VIA_C, the only one so far, is hapflow.hpp over the C interface.
#ifndef HAPFLOW_ADAPTER_ROAD_HPP
#define HAPFLOW_ADAPTER_ROAD_HPP

#include <hapflow/hapflow.hpp>

#include <type_traits>
#include <utility>

namespace hapflow::adapter {

/// The types that the adapters are written over.
struct ViaC {
    using Scene = hapflow::Scene;
    using Session = hapflow::Session;
};
using Road = ViaC;

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
