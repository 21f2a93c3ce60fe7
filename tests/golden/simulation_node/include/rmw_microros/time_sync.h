#error "The component 'time_sync' is not selected: add `components: [+time_sync]` to microros.yaml and generate again"
