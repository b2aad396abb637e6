// Checks the node tree of a file before Assimp traverses it: Assimp recurses for every level, so a cycle or a great
// depth overflows the stack, and it copies nodes with several parents once per parent.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// Larger than in any skeleton, small enough for any stack.
inline constexpr std::size_t deepest_nesting = 200, deepest_node = 1000;

/// `children_of(node)` lists the children of a node. Empty if the tree can be walked in about as many steps as there
/// are nodes, otherwise the problem.
template <class Node, class ChildrenOf>
std::string problem_of_tree(const std::vector<Node>& roots, std::size_t nodes, ChildrenOf&& children_of) {
    struct Visit {
        Node node;
        std::size_t depth;
    };
    std::vector<Visit> open;
    for (const Node& root : roots) open.push_back({root, 1});
    // Some exporters list a node twice; many repetitions are an attack.
    std::size_t left = 4 * nodes + 100;
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (visit.depth > deepest_node) return "has nodes nested more than " + std::to_string(deepest_node) + " deep";
        if (left-- == 0) return "has nodes that are their own descendants or have many parents";
        for (const Node& child : children_of(visit.node)) open.push_back({child, visit.depth + 1});
    }
    return {};
}

}  // namespace weft
