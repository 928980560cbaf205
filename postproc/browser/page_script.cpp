#include "postproc/browser/page_script.h"

// The file as it is, taken in by the assembler.
__asm__(
    ".pushsection .rodata\n"
    ".global pfdm_page_script_begin\n.global pfdm_page_script_end\n"
    ".hidden pfdm_page_script_begin\n.hidden pfdm_page_script_end\n"
    "pfdm_page_script_begin:\n.incbin \"" PFDM_PAGE_SCRIPT
    "\"\npfdm_page_script_end:\n.byte 0\n"
    ".popsection\n");

extern "C" const char pfdm_page_script_begin[], pfdm_page_script_end[];  // NOLINT

namespace pfdm {

std::string_view page_script() {
  return {pfdm_page_script_begin, static_cast<std::size_t>(pfdm_page_script_end - pfdm_page_script_begin)};
}

}  // namespace pfdm
