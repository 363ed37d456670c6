// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "support/rows.hpp"

#include <ostream>

#include <nlohmann/json.hpp>

#include "ism/io/write_file.hpp"

namespace bench {

void write_json(const std::filesystem::path& path, const std::vector<Row>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : rows)
        list.push_back({{"case", row.name},
                        {"ours", row.ours},
                        {"peer", row.peer},
                        {"peer_name", row.peer_name},
                        {"unit", row.unit},
                        {"ratio", row.peer / row.ours},
                        {"correct", row.correct},
                        {"remark", row.remark}});
    ism::write_file(path, [&](std::ostream& out) { out << list.dump(1) << '\n'; });
}

}  // namespace bench
