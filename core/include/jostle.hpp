// C++17 wrapper of the C interface, in this header alone: worlds and scenes that free themselves, errors as
// exceptions, columns and events as ranges. Functions without a wrapper are called as in C, with the handle of
// `get()`.
#ifndef JOSTLE_HPP
#define JOSTLE_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jostle.h"

namespace jostle {

// Exception for a JoError: what() is its text, after file and line if these are known.
class Error : public std::runtime_error {
  public:
    explicit Error(const JoError &error) : std::runtime_error(text_of(error)), error_(error) {}
    int code() const noexcept { return static_cast<int>(error_.code); }
    const JoError &error() const noexcept { return error_; }

  private:
    static std::string text_of(const JoError &error) {
        std::string place = error.file;
        for (const int number : {error.line, error.line ? error.column : 0})
            if (number)
                place += ":" + std::to_string(number);
        return place.empty() ? error.text : place + ": " + error.text;
    }
    JoError error_;
};

namespace detail {
inline void require(bool good, const JoError &error) {
    if (!good)
        throw Error(error);
}
} // namespace detail

// View of `count` items at a pointer, valid as long as the C interface says.
template <class T> class Range {
  public:
    Range(const T *data, std::size_t count) noexcept : data_(data), count_(count) {}
    const T *begin() const noexcept { return data_; }
    const T *end() const noexcept { return data_ + count_; }
    std::size_t size() const noexcept { return count_; }
    bool empty() const noexcept { return count_ == 0; }
    const T &operator[](std::size_t n) const noexcept { return data_[n]; }

  private:
    const T *data_;
    std::size_t count_;
};

template <class T> struct TypeOf;
template <> struct TypeOf<std::uint8_t> { static constexpr JoType value = JO_U8; };
template <> struct TypeOf<std::uint16_t> { static constexpr JoType value = JO_U16; };
template <> struct TypeOf<std::uint32_t> { static constexpr JoType value = JO_U32; };
template <> struct TypeOf<std::int32_t> { static constexpr JoType value = JO_I32; };
template <> struct TypeOf<std::uint64_t> { static constexpr JoType value = JO_U64; };
template <> struct TypeOf<float> { static constexpr JoType value = JO_F32; };
template <> struct TypeOf<double> { static constexpr JoType value = JO_F64; };

// View of one number per agent, read in place: column[i] is that of agent i, until the next step.
template <class T> class Column {
  public:
    explicit Column(const JoColumn &column) noexcept
        : data_(static_cast<const char *>(column.data)), stride_(column.stride),
          count_(column.data ? column.count : 0) {}
    std::size_t size() const noexcept { return count_; }
    const T &operator[](std::size_t i) const noexcept {
        return *reinterpret_cast<const T *>(data_ + i * stride_);
    }

  private:
    const char *data_;
    std::size_t stride_, count_;
};

// Arrays of JoEvents as ranges, valid until the next call on the world.
struct Events {
    explicit Events(const JoEvents &e) noexcept
        : transitions(e.transitions, e.transition_count), touches(e.touches, e.touch_count),
          hits(e.hits, e.hit_count), breaks(e.breaks, e.break_count),
          entered(e.entered, e.entered_count), left(e.left, e.left_count),
          said(e.said, e.said_count), actions(e.actions, e.action_count) {}
    Range<JoTransitionEvent> transitions;
    Range<JoTouchEvent> touches;
    Range<JoHitEvent> hits;
    Range<JoBreakEvent> breaks;
    Range<JoPresenceEvent> entered, left;
    Range<JoSaidEvent> said;
    Range<JoActionEvent> actions;
};

// Non-owning reference to a world, of a Scene or a World.
class WorldRef {
  public:
    explicit WorldRef(JoWorld *world) noexcept : world_(world) {}
    JoWorld *get() const noexcept { return world_; }
    double time() const noexcept { return jo_world_time(world_); }
    std::uint64_t hash() const noexcept { return jo_world_hash(world_); }
    std::uint32_t agent_count() const noexcept { return jo_world_agent_count(world_); }

    // Finds a column. Throws std::invalid_argument if there is none with that name, or its numbers have another type.
    template <class T> Column<T> column(const char *name) const {
        const JoColumn column = jo_world_column(world_, name);
        if (column.data && column.type != TypeOf<T>::value)
            throw std::invalid_argument(std::string("the column '") + name + "' is of another type");
        if (!column.data && agent_count() > 0)
            throw std::invalid_argument(std::string("there is no column '") + name + "'");
        return Column<T>(column);
    }

    // Events of the last step.
    Events events() const { return Events(jo_world_events(world_)); }

    JoAgent spawn(const char *group, double x, double y) {
        JoError error{};
        const JoAgent agent = jo_world_spawn(world_, group, x, y, &error);
        detail::require(agent.generation != 0, error);
        return agent;
    }
    // Index of a storey by its name, for the calls that take one. Throws std::invalid_argument if there is none.
    std::uint32_t storey(const char *name) const {
        const std::uint32_t found = jo_world_find_storey(world_, name);
        if (found == JO_NO_STOREY)
            throw std::invalid_argument(std::string("there is no storey '") + name + "'");
        return found;
    }
    JoAgent spawn_on(const char *group, std::uint32_t storey, double x, double y) {
        JoError error{};
        const JoAgent agent = jo_world_spawn_on(world_, group, storey, x, y, &error);
        detail::require(agent.generation != 0, error);
        return agent;
    }
    std::vector<std::uint32_t> neighbours(double x, double y, double radius) const {
        std::vector<std::uint32_t> ids(jo_world_neighbours(world_, x, y, radius, nullptr, nullptr, 0));
        jo_world_neighbours(world_, x, y, radius, ids.data(), nullptr,
                            static_cast<std::uint32_t>(ids.size()));
        return ids;
    }

  private:
    JoWorld *world_;
};

struct Free {
    void operator()(JoWorld *world) const noexcept { jo_world_free(world); }
    void operator()(JoScene *scene) const noexcept { jo_scene_free(scene); }
    template <class T> void operator()(T *told) const noexcept { jo_free(told); }
};

// Owner of a struct of jostle_tell.h: told->items[0].
template <class T> class Told {
  public:
    // Throws std::bad_alloc for NULL.
    explicit Told(T *told) : told_(told) {
        if (!told)
            throw std::bad_alloc();
    }
    const T *operator->() const noexcept { return told_.get(); }
    const T *get() const noexcept { return told_.get(); }

  private:
    std::unique_ptr<T, Free> told_;
};

// Owner of a world made by hand.
class World : public WorldRef {
  public:
    explicit World(const JoWorldDef &def = jo_default_world_def()) : World(create(def)) {}

    JoAgent add(const JoAgentDef &def) {
        JoError error{};
        const JoAgent agent = jo_world_add_agent(get(), &def, &error);
        detail::require(agent.generation != 0, error);
        return agent;
    }
    JoBody add(const JoBodyDef &def) {
        JoError error{};
        const JoBody body = jo_world_add_body(get(), &def, &error);
        detail::require(body.generation != 0, error);
        return body;
    }
    // Advances the world. Throws std::runtime_error if it has failed.
    void step(std::uint32_t steps = 1) {
        jo_world_step(get(), steps);
        const char *failure = jo_world_failure(get());
        if (failure && *failure)
            throw std::runtime_error(failure);
    }

  private:
    explicit World(JoWorld *world) : WorldRef(world), owned_(world) {}
    static JoWorld *create(const JoWorldDef &def) {
        JoError error{};
        JoWorld *world = jo_world_create(&def, &error);
        detail::require(world != nullptr, error);
        return world;
    }
    std::unique_ptr<JoWorld, Free> owned_;
};

// Owner of a scene, loaded from its file or from a definition.
class Scene {
  public:
    explicit Scene(const JoSceneDef &def) {
        JoError error{};
        scene_.reset(jo_scene_load(&def, &error));
        detail::require(scene_ != nullptr, error);
    }
    explicit Scene(const std::string &path) : Scene(def_of(path)) {}

    JoScene *get() const noexcept { return scene_.get(); }
    WorldRef world() const noexcept { return WorldRef(jo_scene_world(get())); }
    void step(std::uint32_t steps = 1) {
        JoError error{};
        for (std::uint32_t n = 0; n < steps; n++)
            detail::require(jo_scene_step(get(), &error), error);
    }
    void input(const std::string &line) {
        JoError error{};
        detail::require(jo_scene_input(get(), line.c_str(), &error), error);
    }
    // Figures and troubles of the run so far; the results may outlive the scene.
    Told<JoFigures> figures() const { return Told<JoFigures>(jo_scene_figures(get())); }
    Told<JoTroubles> troubles() const { return Told<JoTroubles>(jo_scene_troubles(get())); }
    // Measurements of the n-th probe; throws std::out_of_range if there is none.
    Told<JoTable> probe(std::uint32_t n) const {
        if (!jo_scene_probe_name(get(), n))
            throw std::out_of_range("the scene has no such probe");
        return Told<JoTable>(jo_scene_probe_table(get(), n));
    }

  private:
    static JoSceneDef def_of(const std::string &path) {
        JoSceneDef def = jo_default_scene_def();
        def.path = path.c_str();
        return def;
    }
    std::unique_ptr<JoScene, Free> scene_;
};

} // namespace jostle

#endif
