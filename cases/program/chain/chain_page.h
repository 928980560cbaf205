#pragma once
// The page of a chain: its steps, what passes from one to the next, and what each comes to.

#include "cases/program/chain/chain_record.h"
#include "postproc/page/report_page.h"

#include <string>

namespace pfdm {

ReportPage chain_page(const ChainRecord& record, const std::string& title);

}  // namespace pfdm
