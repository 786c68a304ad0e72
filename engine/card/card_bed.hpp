// A StepLoop's bed on a card: the grains and contacts in its memory, and the evaluations that kernels make of
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/card/bed.hpp"
#include "engine/card/device.hpp"
#include "engine/step/step_device.hpp"

namespace grainreel::card {

// One group of contacts in a card's memory.
class GroupOnCard {
  public:
    GroupOnCard(Device& device, const ContactGroup& group);
    // Takes the contacts as they are now.
    void bring(const ContactRules& rules, const ContactTable& table, std::int32_t grains);
    // Gives them back, after so many evaluations.
    void fetch(const ContactRules& rules, std::size_t number, std::int32_t evaluations,
               ThreadContacts& contacts) const;
    Group group() const { return group_; }

  private:
    struct Lists {
        Array<std::int32_t> start, at;
    };
    void bring_places(const ContactTable& table);
    void bring_late(const ContactTable& table, const std::vector<std::int32_t>& candidates,
                    std::int32_t grains);

    Group group_{};
    Array<double> parameters_, rolling_parameters_, history_, push_;
    Array<std::int32_t> row_, first_, second_, began_, late_start_, late_at_, late_count_;
    Array<std::uint8_t> state_;
    Lists sorted_, candidates_;
};

class CardBed : public StepDevice {
  public:
    explicit CardBed(std::unique_ptr<Device> device);

    std::size_t steps_ahead() const override { return device_->steps_ahead(); }
    void bring(const ContactRules& rules, const Grains& grains, const ThreadContacts& contacts) override;
    DeviceRun run(const std::vector<DeviceStep>& steps, const Reach& reach) override;
    void add_forces(const DeviceStep& step) override;
    void fetch(const ContactRules& rules, Grains& grains, ThreadContacts& contacts) override;

  private:
    void send_walls(const std::vector<DeviceStep>& steps);
    Step step_of(const DeviceStep& step, std::size_t k, double skin) const;
    void send_status(const Status& status);
    void run_forces(const Step& step, bool always);

    std::unique_ptr<Device> device_;
    Bed bed_{};
    std::vector<GroupOnCard> groups_;
    std::vector<ContactModel> models_;
    std::vector<bool> of_pairs_;
    Array<double> place_, motion_, load_, wall_work_, faces_, wall_motion_;
    Array<std::int32_t> species_;
    Array<Group> group_;
    Array<Status> status_;
    Array<Told> told_;
    std::size_t faces_of_step_ = 0;
    std::int32_t evaluations_ = 0;  // since bring()
    std::int64_t parted_now_ = 0;
};

}  // namespace grainreel::card
