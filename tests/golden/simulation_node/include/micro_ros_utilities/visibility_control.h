#error "The component 'micro_ros_utilities' is not selected: add `components: [+micro_ros_utilities]` to microros.yaml and generate again"
