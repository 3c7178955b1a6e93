#pragma once

#include <string>
#include <vector>

#include "campaign/sqlite.h"
#include "campaign/store.h"

namespace gapscope::internal::campaign {

/// Makes the tables of an empty database and writes the header, all at once.
void create_tables(Database& database, const CampaignHeader& header);

bool is_empty(Database& database);  ///< a file without a byte, as a new one is

/// @throws ConfigError for a database of something else, or of another schema
CampaignHeader read_header(Database& database, const std::string& file);

/// Names of the columns of `runs`: run, axes, drawn, fields of a row.
std::vector<std::string> run_columns(const CampaignHeader& header);

std::vector<std::string> timing_columns();  ///< of `timing`, without the run

/// What tells two campaigns apart, "" if nothing does; the shard is not looked at.
/// @param stored, wanted  as the sentence calls them
std::string header_difference(const CampaignHeader& stored, const CampaignHeader& wanted);

}  // namespace gapscope::internal::campaign
