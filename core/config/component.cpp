#include "core/config/component.hpp"

#include <algorithm>

namespace gault::core::config {
namespace {

// Reads values into `store`, which owns what they point to.
class ValueReader {
  public:
    explicit ValueReader(Parameters& store) : store_(store) {}

    std::vector<gault_value> read(const Fields& fields, const gault_parameter* const* parameters,
                                  std::vector<Location>* locations);

  private:
    Parameters& store_;

    gault_value read_one(const Node& node, const std::string& path, const gault_parameter& parameter);
    gault_value fallback(const Fields& fields, const gault_parameter& parameter);
    gault_value text(const std::string& text);
    gault_value list(const Node& node, const std::string& path, const gault_parameter& parameter);
    gault_value table(const Node& node, const std::string& path, const gault_parameter& parameter);
    gault_value records(const Node& node, const std::string& path, const gault_parameter& parameter);
    gault_item record(const Node& node, const std::string& path, const gault_parameter& parameter);
    std::vector<gault_value> record_values(const Node& node, const std::string& path,
                                           const gault_record_kind& kind);
};

std::string unit_of(const char* unit) {
    return unit == nullptr || *unit == '\0' ? "1" : unit;
}

Bounds bounds_of(const gault_parameter& p) {
    return {p.min, p.max, (p.flags & GAULT_MIN_OPEN) != 0, (p.flags & GAULT_MAX_OPEN) != 0};
}

std::string sentence_of(const gault_parameter& p) {
    return p.doc == nullptr ? "" : p.doc;
}

std::vector<std::string> choices_of(const gault_parameter& p) {
    std::vector<std::string> choices;
    for (const char* const* choice = p.choices; choice != nullptr && *choice != nullptr; ++choice)
        choices.emplace_back(*choice);
    return choices;
}

gault_value single(double real) {
    gault_value value{};
    value.real = real;
    value.integer = static_cast<std::int64_t>(real);
    value.text = "";
    value.count = 1;
    return value;
}

gault_value absent() {
    gault_value value = single(0.0);
    value.count = 0;
    return value;
}

gault_value choice(const gault_parameter& p, std::size_t index) {
    gault_value value = single(static_cast<double>(index));
    value.text = p.choices[index];
    return value;
}

gault_value real(double number) {
    gault_value value = single(0.0); // a real has no integer: it may be beyond any
    value.real = number;
    return value;
}

void check_count(const Node& node, const std::string& path, const gault_parameter& p) {
    const auto count = static_cast<std::int64_t>(one_or_more(node).size());
    if (count >= p.min_count && (p.max_count == 0 || count <= p.max_count)) return;
    std::string allowed = std::to_string(p.min_count);
    if (p.max_count == 0)
        allowed = "at least " + allowed;
    else if (p.max_count != p.min_count)
        allowed += " to " + std::to_string(p.max_count);
    throw InputError(node.where(), path + " has " + std::to_string(count) +
                                       (count == 1 ? " item" : " items") + "; allowed: " + allowed + " (" +
                                       sentence_of(p) + ")");
}

std::vector<gault_value> ValueReader::read(const Fields& fields, const gault_parameter* const* parameters,
                                           std::vector<Location>* locations) {
    std::vector<gault_value> values;
    for (auto p = parameters; p != nullptr && *p != nullptr; ++p) {
        const Node* node = fields.find((*p)->name);
        values.push_back(node ? read_one(*node, fields.path((*p)->name), **p) : fallback(fields, **p));
        if (locations) locations->push_back(node ? node->where() : fields.where());
    }
    return values;
}

gault_value ValueReader::fallback(const Fields& fields, const gault_parameter& p) {
    if (p.flags & GAULT_REQUIRED)
        throw InputError(fields.where(), fields.path(p.name) + " is missing (" + sentence_of(p) + ")");
    if (p.flags & GAULT_OPTIONAL) return absent();
    switch (p.type) {
    case GAULT_REAL:
        return real(p.fallback);
    case GAULT_INTEGER:
    case GAULT_BOOLEAN:
        return single(p.fallback);
    case GAULT_CHOICE:
        return choice(p, static_cast<std::size_t>(p.fallback));
    default:
        return absent(); // the other types have no default
    }
}

gault_value ValueReader::read_one(const Node& node, const std::string& path, const gault_parameter& p) {
    switch (p.type) {
    case GAULT_REAL:
        return real(read_quantity(node, path, unit_of(p.unit), bounds_of(p), sentence_of(p)));
    case GAULT_INTEGER: {
        const std::int64_t integer = read_integer(node, path, bounds_of(p), sentence_of(p));
        gault_value value = single(0.0);
        value.real = static_cast<double>(integer);
        value.integer = integer;
        return value;
    }
    case GAULT_BOOLEAN:
        return single(static_cast<double>(read_choice(node, path, {"false", "true"})));
    case GAULT_CHOICE:
        return choice(p, read_choice(node, path, choices_of(p)));
    case GAULT_TEXT_VALUE:
        return text(read_text_value(node, path));
    case GAULT_LIST:
        return list(node, path, p);
    case GAULT_TABLE:
        return table(node, path, p);
    case GAULT_RECORDS:
        return records(node, path, p);
    default:
        throw InputError(node.where(), path + ": its plugin declares a type that is not known here");
    }
}

gault_value ValueReader::text(const std::string& text) {
    gault_value value = single(0.0);
    value.text = store_.texts.emplace_back(text).c_str();
    return value;
}

gault_value ValueReader::list(const Node& node, const std::string& path, const gault_parameter& p) {
    require_kind(node, NodeKind::list, path);
    check_count(node, path, p);
    auto& numbers = store_.numbers.emplace_back();
    for (std::size_t i = 0; i < node.items.size(); ++i)
        numbers.push_back(read_quantity(node.items[i], path + "." + std::to_string(i), unit_of(p.unit),
                                        bounds_of(p), sentence_of(p)));
    gault_value value = absent();
    value.y = numbers.data();
    value.count = static_cast<std::int64_t>(numbers.size());
    return value;
}

gault_value ValueReader::table(const Node& node, const std::string& path, const gault_parameter& p) {
    require_kind(node, NodeKind::list, path);
    check_count(node, path, p);
    auto& x = store_.numbers.emplace_back();
    auto& y = store_.numbers.emplace_back();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const Node& row = node.items[i];
        const std::string row_path = path + "." + std::to_string(i);
        if (row.kind != NodeKind::list || row.items.size() != 2)
            throw InputError(row.where(), row_path + " must be a pair [x, y]; found " + described(row));
        x.push_back(read_quantity(row.items[0], row_path + ".0", unit_of(p.x_unit)));
        y.push_back(
            read_quantity(row.items[1], row_path + ".1", unit_of(p.unit), bounds_of(p), sentence_of(p)));
        if (i > 0 && !(x[i] > x[i - 1]))
            throw InputError(row.items[0].where(), row_path + ".0 is " + described(row.items[0]) +
                                                       "; it must be more than " +
                                                       described(node.items[i - 1].items[0]) + " before it");
    }
    gault_value value = absent();
    value.x = x.data();
    value.y = y.data();
    value.count = static_cast<std::int64_t>(y.size());
    return value;
}

gault_value ValueReader::records(const Node& node, const std::string& path, const gault_parameter& p) {
    check_count(node, path, p);
    std::vector<gault_item> items;
    const auto nodes = one_or_more(node);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        items.push_back(
            record(*nodes[i], node.kind == NodeKind::list ? path + "." + std::to_string(i) : path, p));
    gault_value value = absent();
    value.count = static_cast<std::int64_t>(items.size());
    value.items = store_.items.emplace_back(std::move(items)).data();
    return value;
}

// {kind: {key: value, ...}}, {kind: value}, or the bare word of a kind that needs nothing
gault_item ValueReader::record(const Node& node, const std::string& path, const gault_parameter& p) {
    std::vector<std::string> kinds;
    for (auto kind = p.kinds; kind != nullptr && *kind != nullptr; ++kind)
        kinds.emplace_back((*kind)->name);
    const bool word = node.kind == NodeKind::scalar;
    if (!word && (node.kind != NodeKind::map || node.keys.size() != 1))
        throw InputError(node.where(),
                         path + " must be a single {kind: value}; found " + described(node) +
                             (node.kind == NodeKind::map && !node.keys.empty()
                                  ? " of " + std::to_string(node.keys.size()) + " (write a list)"
                                  : did_you_mean("", kinds)));
    const std::string& name = word ? node.text : node.keys[0].text;
    const auto found = std::find(kinds.begin(), kinds.end(), name);
    if (found == kinds.end())
        throw InputError(word ? node.where() : node.keys[0].place.location(),
                         path + ": unknown kind " + in_quotes(name) + did_you_mean(name, kinds));
    const auto kind = found - kinds.begin();
    Node nothing;
    nothing.kind = NodeKind::map;
    nothing.place = node.place;
    auto values = record_values(word ? nothing : node.items[0], path + "." + name, *p.kinds[kind]);
    return {kind, store_.nested.emplace_back(std::move(values)).data()};
}

std::vector<gault_value> ValueReader::record_values(const Node& node, const std::string& path,
                                                    const gault_record_kind& kind) {
    const auto names = parameter_names(kind.parameters);
    const bool shorthand =
        names.size() == 1 && (node.kind != NodeKind::map ||
                              (kind.parameters[0]->type == GAULT_RECORDS && node.find(names[0]) == nullptr));
    if (!shorthand) return read(Fields(node, path, names), kind.parameters, nullptr);
    if (node.kind == NodeKind::null) throw InputError(node.where(), path + " has no value");
    return {read_one(node, path, *kind.parameters[0])};
}

} // namespace

std::vector<std::string> parameter_names(const gault_parameter* const* parameters) {
    std::vector<std::string> names;
    for (auto p = parameters; p != nullptr && *p != nullptr; ++p)
        names.emplace_back((*p)->name);
    return names;
}

Parameters read_parameters(const Node& map, const std::string& path,
                           const std::vector<std::string>& host_keys, const Component& component) {
    std::vector<std::string> keys = host_keys;
    for (auto& name : parameter_names(component.declaration->parameters))
        if (std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(std::move(name));
    Parameters parameters;
    const Fields fields(map, path, keys);
    parameters.where = fields.where();
    parameters.values =
        ValueReader(parameters).read(fields, component.declaration->parameters, &parameters.locations);
    return parameters;
}

ComponentUse read_component(const Node& map, const std::string& path,
                            const std::vector<std::string>& host_keys, gault_kind kind,
                            const Registry& registry) {
    const Node* type = require_kind(map, NodeKind::map, path).find("type");
    if (type == nullptr)
        throw InputError(map.where(), path + ".type is missing: the name of a " + kind_name(kind));
    const Component& component = registry.find(kind, read_name(*type, path + ".type"), type->where());
    return {&component, read_parameters(map, path, host_keys, component)};
}

} // namespace gault::core::config
