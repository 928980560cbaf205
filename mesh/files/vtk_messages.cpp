#include "mesh/files/vtk_messages.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace pfdm {
namespace {

// Takes what VTK would print on standard error.
class MessageCatcher : public vtkOutputWindow {
 public:
  static MessageCatcher* New();
  vtkTypeMacro(MessageCatcher, vtkOutputWindow) void DisplayText(const char* text) override { text_ += text; }
  void DisplayWarningText(const char*) override {}  // a file of a later version, say, may still be read
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};
vtkStandardNewMacro(MessageCatcher)

}  // namespace

struct CaughtVtkMessages::Catch {
  vtkSmartPointer<vtkOutputWindow> window = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity log = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<MessageCatcher> catcher;
};

CaughtVtkMessages::CaughtVtkMessages() : catch_(std::make_unique<Catch>()) {
  vtkOutputWindow::SetInstance(catch_->catcher);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

CaughtVtkMessages::~CaughtVtkMessages() {
  vtkOutputWindow::SetInstance(catch_->window);
  vtkLogger::SetStderrVerbosity(catch_->log);
}

bool CaughtVtkMessages::none() const { return catch_->catcher->text().empty(); }

// Above it stands "ERROR: In <file>, line <n>", before it the reader's address.
std::string CaughtVtkMessages::first() const {
  const std::string& text = catch_->catcher->text();
  if (text.empty()) return text;
  std::string line = text.substr(std::min(text.find('\n'), text.size() - 1) + 1);
  line.resize(std::min(line.find('\n'), line.size()));
  const std::size_t address = line.starts_with("vtk") ? line.find("): ") : std::string::npos;
  return address == std::string::npos ? line : line.substr(address + 3);
}

}  // namespace pfdm
